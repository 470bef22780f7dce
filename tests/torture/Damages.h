#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Judge.h"

namespace quadmap::torture
{
using Cases = std::vector<Case>;

std::string littleEndian(std::uint32_t number);
std::string gzipped(const std::string& bytes);

/** An object as MRPT writes it: the name of its class, its content and the mark of its end. */
std::string object(const std::string& name, int version, const std::string& content);

/** The same file with one part replaced by another. The part has to be there. */
std::string with(const std::string& whole, const std::string& part, const std::string& other);

/** Cut at evenly spaced places, and shortly before the end. */
Cases cuts(const std::string& whole, int count);
/** One bit flipped at a time, at evenly spaced places. */
Cases flips(const std::string& whole, int count);
/** Four bytes at a time replaced by a huge number, at evenly spaced places. */
Cases hugeNumbers(const std::string& whole, int count);
/** One word of a text at a time replaced by one that makes no sense there. */
Cases wrongWords(const std::string& whole, int count);
/** The cases, each compressed after the damage. */
Cases compressed(Cases cases);

/** The cases, whose messages have to name this place. */
Cases at(const std::string& place, Cases cases);

Cases operator+(Cases a, const Cases& b);

}  // namespace quadmap::torture
