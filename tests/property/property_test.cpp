// Some small cases in every build; tests/property/run makes thousands, larger ones among them.

#include <gtest/gtest.h>

#include <algorithm>

#include "check.hpp"
#include "limits.hpp"

namespace qmcf::property {
namespace {

constexpr std::uint64_t kFirstSeed = 1;
constexpr std::uint64_t kCases = 150;
constexpr std::size_t kMostTriangles = 700;  ///< Finer parts, which are revolutions, take too long for every build.

TEST(Property, SmallCasesAreValidConformingAndClosed) {
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kCases; ++seed) {
    const Case made = makeCase(seed, kSmallCases);
    if (made.part.triangles.size() > kMostTriangles) continue;
    SilentProgress silent;
    for (const std::string& fault : runCase(made, silent)) {
      ADD_FAILURE() << "seed " << seed << " (" << describe(made) << "): " << fault;
    }
  }
}

TEST(Property, FallsBackOnThePartsOwnTriangles) {
  // A ring far narrower than the elements, around a polygon whose corners chords miss by more than its width: elements
  // of no size tried lie on it.
  Case made = makeCase(7, kSmallCases);
  made.options.sizes.clear();
  made.options.curvature.reset();
  SilentProgress silent;
  MeshResult result;
  EXPECT_EQ(runCase(made, silent, &result), std::vector<std::string>{});
  EXPECT_TRUE(std::any_of(result.faces.begin(), result.faces.end(),
                          [](const FaceReport& face) { return face.method == "given"; }));
}

TEST(Property, CasesAreTheSameEachTime) {
  const Case one = makeCase(7, kSmallCases);
  const Case two = makeCase(7, kSmallCases);
  EXPECT_EQ(one.part.positions, two.part.positions);
  EXPECT_EQ(one.part.triangles, two.part.triangles);
}

}  // namespace
}  // namespace qmcf::property
