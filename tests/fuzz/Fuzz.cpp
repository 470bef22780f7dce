#include "Fuzz.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <exception>

#include "AllocationWatch.h"
#include "Coverage.h"
#include "quadmap/base/ErrorText.h"

namespace quadmap
{
namespace
{
/** Whole seconds are far more than any of these small inputs needs, sanitizers included. */
constexpr double kLong = 5.0;

/** Processor time: a machine that does other things, or stops this program for a while, is no fault
 * of a parser. */
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/** How many inputs to try: QUADMAP_FUZZ_RUNS when it is set, for long runs by .ci/fuzz. */
int inputsOf(const FuzzRun& run)
{
  const char* wanted = std::getenv("QUADMAP_FUZZ_RUNS");
  return wanted ? std::atoi(wanted) : run.count;
}

std::string readable(const std::string& bytes)
{
  constexpr std::size_t kShown = 2000;
  return ::testing::PrintToString(bytes.substr(0, kShown));
}
}  // namespace

void fuzz(
    const std::string& valid,
    const FuzzRun& run,
    const std::function<void(const std::string&)>& parse)
{
  Coverage::reset();
  ASSERT_NO_THROW(parse(valid)) << "the undamaged input";
  Coverage::foundNew();
  std::vector<std::string> corpus = {valid};
  Mutator mutator(run.seed);
  mutator.dictionary.insert(mutator.dictionary.end(), run.words.begin(), run.words.end());
  int refused = 0;
  const int count = inputsOf(run);
  for (int i = 0; i < count; ++i)
  {
    const std::string input = mutator.mutate(mutator.choose(corpus));
    AllocationWatch::reset();
    Coverage::reset();
    const double start = seconds();
    try
    {
      parse(input);
    }
    catch (const std::exception& e)
    {
      ++refused;
      EXPECT_STRNE(e.what(), "") << "an error without words, input " << readable(input);
      ASSERT_PRED_FORMAT2(::testing::IsSubstring, run.place, rootMessage(e))
          << "mutation " << i << ": the error does not name the place, input " << readable(input);
    }
    catch (...)
    {
      FAIL() << "threw something else than std::exception for " << readable(input);
    }
    if (Coverage::foundNew()) corpus.push_back(input);
    ASSERT_LT(seconds() - start, kLong) << readable(input);
    ASSERT_LE(AllocationWatch::largest(), run.largestAllocation)
        << "mutation " << i << ": " << readable(input);
  }
  const int fewest = run.mostlyHarmless ? 0 : count / 20;
  EXPECT_GE(refused, fewest) << "the damage hardly ever hits: this tests nothing";
}

}  // namespace quadmap
