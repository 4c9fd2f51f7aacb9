#include <gtest/gtest.h>

#include <cmath>

#include "field/patches.hpp"
#include "qmcf/field/cross_field.hpp"

namespace qmcf {
namespace {

CrossField smoothest(const Patch& patch, FieldEnergy energy, double smoothness) {
  FieldOptions options;
  options.curvature = false;
  options.diffuse = false;
  options.cancelDistance = 0.0;
  options.energy = energy;
  options.smoothness = smoothness;
  SilentProgress progress;
  Result<CrossField> field = computeCrossField(patch, {}, options, progress);
  EXPECT_TRUE(field.ok());
  return std::move(field).value();
}

// On the unit sphere the least eigenvalue of fields of degree n is n (1 - s), here n = 4 (Knoeppel et al. 2013).
TEST(FieldSpectrum, OfSphereMatchesTheContinuum) {
  const Patch patch = testing::makeSphere(24);
  for (const double s : {-1.0, 0.0, 1.0}) {
    const CrossField field = smoothest(patch, FieldEnergy::finiteElements, s);
    EXPECT_NEAR(field.eigenvalue, 4.0 * (1.0 - s), 0.08) << s;
    ASSERT_EQ(field.singularities.size(), 8U) << s;
    for (const Singularity& singularity : field.singularities) EXPECT_EQ(singularity.index, 1);
  }
  const CrossField field = smoothest(patch, FieldEnergy::cotangent, 0.0);
  EXPECT_NEAR(field.eigenvalue, 4.0, 0.05);
}

TEST(FieldSpectrum, ConvergesWithTheSquareOfTheEdgeLength) {
  const double coarse =
      std::fabs(smoothest(testing::makeSphere(10), FieldEnergy::finiteElements, 0.0).eigenvalue - 4.0);
  const double fine = std::fabs(smoothest(testing::makeSphere(20), FieldEnergy::finiteElements, 0.0).eigenvalue - 4.0);
  EXPECT_NEAR(coarse / fine, 4.0, 0.6);
}

// A constant cross is parallel on a flat square and has no energy, whatever the discretisation.
TEST(FieldSpectrum, OfFreeSquareStartsAtZero) {
  FieldOptions options;
  options.boundary = false;
  options.curvature = false;
  options.energy = FieldEnergy::finiteElements;
  SilentProgress progress;
  const Patch patch = testing::makeSquare(8);
  const Result<CrossField> field = computeCrossField(patch, {}, options, progress);
  ASSERT_TRUE(field.ok());
  EXPECT_NEAR(field.value().eigenvalue, 0.0, 1e-6);
  EXPECT_TRUE(field.value().singularities.empty());
}

}  // namespace
}  // namespace qmcf
