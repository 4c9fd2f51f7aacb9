#include <gtest/gtest.h>

#include <cmath>

#include "field/patches.hpp"
#include "field/solve.hpp"
#include "qmcf/field/cross_field.hpp"

namespace qmcf {
namespace {

using testing::solve;

TEST(ClosedField, OfSphereHasEightSingularities) {
  const Patch patch = testing::makeSphere(16);
  const CrossField field = solve(patch);
  EXPECT_EQ(gaussBonnetDefect(patch, field), 0);
  EXPECT_EQ(field.singularities.size(), 8U);
  for (const Singularity& s : field.singularities) EXPECT_EQ(s.index, 1);
}

TEST(ClosedField, OfTorusHasSingularitiesThatCancel) {
  const Patch patch = testing::makeTorus(48, 20);
  const CrossField field = solve(patch);
  EXPECT_EQ(gaussBonnetDefect(patch, field), 0);
  EXPECT_EQ(field.singularities.size() % 2, 0U);
}

TEST(ClosedField, HasTheSumOfIndicesThatItsGenusDemands) {
  const std::vector<std::pair<int, Patch>> patches = {{0, testing::makeSphere(10)},
                                                      {1, testing::makeTorus(40, 16)},
                                                      {1, testing::makePretzel(1, 5)},
                                                      {2, testing::makePretzel(2, 5)},
                                                      {3, testing::makePretzel(3, 5)}};
  for (const auto& [genus, patch] : patches) {
    ASSERT_EQ(patch.surface.eulerCharacteristic(), 2 - 2 * genus);
    for (const bool diffuse : {true, false}) {
      for (const FieldEnergy energy : {FieldEnergy::cotangent, FieldEnergy::finiteElements}) {
        FieldOptions options;
        options.diffuse = diffuse;
        options.energy = energy;
        const CrossField field = solve(patch, options);
        std::int32_t sum = 0;
        for (const Singularity& s : field.singularities) sum += s.index;
        EXPECT_EQ(sum, 4 * (2 - 2 * genus));
        EXPECT_EQ(gaussBonnetDefect(patch, field), 0);
      }
    }
  }
}

TEST(ClosedField, OfTinyPatchesExists) {
  const Patch triangle = testing::makePatch({{0, 0, 0}, {1, 0, 0}, {0.5, 0.9, 0}}, {{0, 1, 2}}, 1.0);
  const CrossField field = solve(triangle);
  ASSERT_EQ(field.singularities.size(), 1U);  // Three corners with one quad each leave one quarter turn.
  EXPECT_EQ(field.singularities[0].index, 1);
  EXPECT_EQ(gaussBonnetDefect(triangle, field), 0);

  const auto map = [](double x, double y) { return Vec3{x, 0.1 * y, 0.0}; };
  const Patch strip = testing::makeGrid({.nx = 6, .ny = 1, .map = map, .keep = {}}, 0.1);
  const CrossField alongStrip = solve(strip);
  EXPECT_EQ(gaussBonnetDefect(strip, alongStrip), 0);
  EXPECT_TRUE(alongStrip.singularities.empty());
}

}  // namespace
}  // namespace qmcf
