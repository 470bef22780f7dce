#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "../apps/RunProgram.h"

using namespace quadmap;
using nlohmann::json;

// A change that costs accuracy is seen at once: two scenes with few frames, on drifting odometry,
// through all programs. Every bound is the mean over the seeds 1 to 5 (office: 1 to 4) plus or
// minus three standard deviations of them, rounded outwards.
namespace
{
struct Guard
{
  const char* scene;
  int frames;
  int minMatched, maxFalse;     // objects
  double maxAte;                // [m]
  double maxTrans, maxRot_deg;  // [m], [deg]
  double minShape, minIoU;
};

// Home: matched 15.6 +- 0.5, ATE 0.0155 +- 0.0029, Trans 0.024 +- 0.005, Rot 0.41 +- 0.13, Shape
// 0.876
// +- 0.016, 3-D IoU 0.808 +- 0.021, never a false object.
constexpr Guard kHome{"home", 60, 14, 1, 0.025, 0.040, 0.80, 0.828, 0.745};

// Office: matched 18.5 +- 1.3, false 0.75 +- 0.5, ATE 0.0188 +- 0.0055, Trans 0.059 +- 0.005, Rot
// 0.98 +- 0.25, Shape 0.779 +- 0.034, 3-D IoU 0.521 +- 0.026.
constexpr Guard kOffice{"office", 50, 14, 2, 0.036, 0.075, 1.73, 0.677, 0.441};

void expectSuccess(const std::string& program, const std::string& arguments)
{
  const auto result = runProgram(program, arguments);
  ASSERT_EQ(result.status, 0) << program << " " << arguments << "\n" << result.err;
}

void expectWithin(const Guard& guard)
{
  const TemporaryFolder folder;
  const std::string rawlog = folder.path("x.rawlog"), out = folder.path("out");
  ASSERT_NO_FATAL_FAILURE(expectSuccess(
      "quadmap-simulate", guard.scene + std::string(" --seed 1 --resolution 320x240 --frames ") +
                              std::to_string(guard.frames) + " -o " + rawlog));
  ASSERT_NO_FATAL_FAILURE(
      expectSuccess("quadmap-slam", rawlog + " -o " + out + " --odometry rawlog -v warn"));
  ASSERT_NO_FATAL_FAILURE(expectSuccess(
      "quadmap-evaluate", out + " --objects " + folder.path("x.objects.gt.json") +
                              " --trajectory " + folder.path("x.groundtruth.tum") + " --json " +
                              folder.path("figures.json")));
  const json figures = json::parse(readFile(folder.path("figures.json")));
  const json &o = figures["objects"], &t = figures["trajectory"];
  EXPECT_GE(o["matched"], guard.minMatched) << o;
  EXPECT_LE(o["estimated"].get<int>() - o["matched"].get<int>(), guard.maxFalse) << o;
  EXPECT_LE(t["ate_rmse_m"], guard.maxAte) << t;
  EXPECT_LT(t["ate_rmse_m"], t["ate_rmse_odometry_m"]) << "objects must help the trajectory";
  EXPECT_LE(o["trans_m"], guard.maxTrans) << o;
  EXPECT_LE(o["rot_deg"], guard.maxRot_deg) << o;
  EXPECT_GE(o["shape_iou"], guard.minShape) << o;
  EXPECT_GE(o["iou_3d"], guard.minIoU) << o;
}
}  // namespace

TEST(RegressionGuard, Home) { expectWithin(kHome); }

TEST(RegressionGuard, Office) { expectWithin(kOffice); }
