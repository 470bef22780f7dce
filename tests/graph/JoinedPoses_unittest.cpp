#include <gtest/gtest.h>

#include "quadmap/graph/FactorGraph.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
/** Four poses in two pieces, 0 with 1 and 2 with 3. A step and an object join those of a piece. The
 * object has the number of the second one. */
class TwoPieces
{
 public:
  TwoPieces()
  {
    for (int k = 0; k < 4; ++k) graph.addPose(CPose3D(k, 0, 0, 0, 0, 0));
    for (const ObjectId last : {1U, 3U})
    {
      graph.addStep(last - 1, last, oneMetre());
      graph.setObject(last, Ellipsoid(CPose3D(5, 1, 0, 0, 0, 0), {0.3, 0.2, 0.4}), {});
      addView(last - 1, last);
      addView(last, last);
    }
  }

  static CPose3DPDFGaussian oneMetre()
  {
    CPose3DPDFGaussian step(CPose3D(1, 0, 0, 0, 0, 0));
    for (int i = 0; i < 6; ++i) step.cov(i, i) = 1e-4;
    return step;
  }

  void addView(std::size_t pose, ObjectId id)
  {
    const Ellipsoid object = graph.object(id).transformed(-graph.pose(pose));
    BoxMeasurement view;
    view.complete = view.yawDefined = true;
    view.center = object.center();
    view.halfSizes = object.semiAxes();
    view.yawSigma = view.tiltSigma = 0.01;
    for (auto& face : view.faces) face = {FaceKind::Measured, 0.01};
    graph.addView(pose, id, view);
  }

  /** That all is known to decimetres, or that nothing is told. */
  void expectDetermined(bool determined)
  {
    const auto each = graph.poseMarginals();
    const auto joint = graph.jointMarginal({0, 3, 2, 1});
    ASSERT_EQ(each.size(), determined ? 4U : 0U);
    ASSERT_EQ(joint.has_value(), determined);
    for (const auto& covariance : each) EXPECT_LT(covariance.diagonal().maxCoeff(), 0.01);
    if (!joint) return;
    EXPECT_LT(joint->diagonal().maxCoeff(), 0.01);
  }

  FactorGraph graph{FactorGraphOptions()};
};

}  // namespace

TEST(JoinedPoses, NothingIsToldOfTwoPieces) { TwoPieces().expectDetermined(false); }

TEST(JoinedPoses, AStepJoinsTwoPieces)
{
  TwoPieces pieces;
  pieces.graph.addKnownStep(1, 2, TwoPieces::oneMetre());
  pieces.expectDetermined(true);
}

TEST(JoinedPoses, AnObjectJoinsTwoPieces)
{
  TwoPieces pieces;
  pieces.addView(2, 1);
  pieces.expectDetermined(true);
}

TEST(JoinedPoses, KnownObjectsJoinAPieceToTheFirstPose)
{
  TwoPieces pieces;
  ObjectPrior known;
  known.at = objectBlockOf(pieces.graph.object(3), ObjectFreedom::Upright);
  known.L = 1e4 * Eigen::MatrixXd::Identity(7, 7);
  known.g = Eigen::VectorXd::Zero(7);
  pieces.graph.setObjectPrior(3, known);
  pieces.expectDetermined(true);
}
