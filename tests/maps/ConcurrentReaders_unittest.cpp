#include <gtest/gtest.h>

#include <mutex>
#include <thread>
#include <vector>

#include "ObjectMapFixture.h"

namespace quadmap::testing
{
namespace
{
/** Everything a program may ask of a map that it does not change. */
struct Answers
{
  std::vector<double> logLikelihoods;
  std::string text;
  double nearestX = 0;
  std::size_t records = 0, footprintCorners = 0;

  bool operator==(const Answers& other) const
  {
    return logLikelihoods == other.logLikelihoods && text == other.text &&
           nearestX == other.nearestX && records == other.records &&
           footprintCorners == other.footprintCorners;
  }
};

Answers ask(const CQuadricObjectMap& map, const CObservationObjects& seen)
{
  Answers answers;
  for (int i = 0; i < 10; ++i)
    answers.logLikelihoods.push_back(
        map.computeObservationLikelihood(seen, mrpt::poses::CPose3D(0.1 * i, 0, 0, 0.1 * i, 0, 0)));
  answers.text = map.asString();
  const MapObject* nearest = map.nearest({0, 0, 0});
  answers.nearestX = nearest->object.center().x();
  answers.footprintCorners = map.footprint(nearest->id).size();
  answers.records = map.toRecords().size();
  return answers;
}
}  // namespace

TEST(ConcurrentReaders, GetTheAnswersOfASingleOne)
{
  const CQuadricObjectMap map = smallMap();
  SyntheticCamera camera(7);
  const auto seen = camera.observe(
      SyntheticCamera::lookAt({2, 0, 1.2}, {0, 0, 0.3}),
      {cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4)});
  const Answers alone = ask(map, seen);

  constexpr int kThreads = 4, kRounds = 20;
  std::mutex lock;
  int different = 0;
  std::vector<std::thread> readers;
  for (int t = 0; t < kThreads; ++t)
    readers.emplace_back(
        [&]
        {
          for (int i = 0; i < kRounds; ++i)
          {
            const bool same = ask(map, seen) == alone;
            const std::lock_guard<std::mutex> guard(lock);
            different += same ? 0 : 1;
          }
        });
  for (auto& reader : readers) reader.join();
  EXPECT_EQ(different, 0);
}

}  // namespace quadmap::testing
