#include "qmcf/pipeline/mesh_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "front/trace_replay.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/base/random.hpp"
#include "qmcf/pipeline/report_json.hpp"
#include "sizing/parts.hpp"
#include "topology/shapes.hpp"

namespace qmcf {
namespace {

MeshResult mesh(const TriangleMesh& part, std::int64_t quads) {
  SilentProgress silent;
  MeshOptions options;
  options.quads = quads;
  auto result = meshSurface(part, options, silent);
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return std::move(result).value();
}

/// That the history of each face ends with as many elements as its report tells.
void expectReplayed(const MeshResult& result) {
  const MeshTrace& trace = *result.trace;
  ASSERT_EQ(trace.faces.size(), result.faces.size());
  for (std::size_t f = 0; f < trace.faces.size(); ++f) {
    testing::TraceReplay replay;
    for (const TraceStep& step : trace.faces[f].steps) replay.apply(step);
    EXPECT_EQ(replay.count(true), result.faces[f].quads);
    EXPECT_EQ(replay.count(false), result.faces[f].triangles);
  }
}

void expectGood(const MeshResult& result) {
  EXPECT_TRUE(result.quality.valid);
  for (const ValidityCheck& check : result.quality.checks) {
    EXPECT_NE(check.status, CheckStatus::fail) << check.name << ": " << check.sentence;
  }
  EXPECT_GE(result.quality.quadShare, 0.95);
  EXPECT_GE(result.quality.sharpRecall.value_or(1.0), 0.99);
  EXPECT_GE(result.quality.cornerRecall.value_or(1.0), 0.99);
  EXPECT_GE(result.quality.boundaryRecall.value_or(1.0), 0.99);
}

TEST(MeshSurface, MeshesACubeAsSixGrids) {
  const MeshResult result = mesh(shapes::cubeSoup(1), 600);
  expectGood(result);
  EXPECT_EQ(result.quality.quads, 600);
  EXPECT_EQ(result.quality.triangles, 0);
  EXPECT_EQ(result.quality.eulerCharacteristic, 2);
  EXPECT_NEAR(result.quality.scaledJacobian.worst, 1.0, 1e-6);
}

TEST(MeshSurface, DoesNotDependOnTheTessellation) {
  // Two rings of needles and a fine grid are the same cylinder.
  const MeshResult needles = mesh(shapes::cylinder(48, 1, 4.0), 1500);
  const MeshResult fine = mesh(shapes::cylinder(48, 40, 4.0), 1500);
  expectGood(needles);
  expectGood(fine);
  EXPECT_NEAR(needles.quality.scaledJacobian.mean, fine.quality.scaledJacobian.mean, 0.02);
}

TEST(MeshSurface, MeshesWithTheOriginalFront) {
  SilentProgress silent;
  MeshOptions options;
  options.quads = 800;
  options.mode = Mode::qmorph;
  const auto result = meshSurface(shapes::cylinder(48, 1, 4.0), options, silent);
  ASSERT_TRUE(result.ok());
  expectGood(result.value());
  for (const FaceReport& face : result.value().faces) EXPECT_EQ(face.method, "qmorph");
  EXPECT_EQ(result.value().fieldSingularities, 0);
  // It merges triangles of the element size, so the count asked for is met roughly.
  EXPECT_NEAR(static_cast<double>(result.value().quality.quads), 800.0, 160.0);
}

TEST(MeshSurface, MeshesClosedSmoothAndNonManifoldParts) {
  expectGood(mesh(shapes::torus(60, 24, 3.0, 1.0), 1500));
  const TriangleMesh tee = shapes::join(shapes::moved(shapes::square(4),
                                                      [](const Vec3& p) {
                                                        return Vec3{p.x - 0.5, p.y, 0.0};
                                                      }),
                                        shapes::moved(shapes::square(4), [](const Vec3& p) {
                                          return Vec3{0.0, p.x, p.y};
                                        }));
  const MeshResult result = mesh(tee, 400);
  expectGood(result);
  ASSERT_TRUE(result.quality.nonManifoldRecall.has_value());
  EXPECT_GE(*result.quality.nonManifoldRecall, 0.99);
}

TEST(MeshSurface, KeepsEveryCornerOfAPrism) {
  const std::vector<Vec2> l{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  expectGood(mesh(shapes::prism(l, {0.5, 0.5}), 1000));
}

MeshResult allQuad(const TriangleMesh& part, std::int64_t quads) {
  SilentProgress silent;
  MeshOptions options;
  options.quads = quads;
  options.allQuad = true;
  auto result = meshSurface(part, options, silent);
  EXPECT_TRUE(result.ok());
  return std::move(result).value();
}

TEST(MeshSurface, MakesQuadrilateralsOnlyWhenAsked) {
  const std::vector<Vec2> l{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  TriangleMesh triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  const TriangleMesh tee = shapes::join(shapes::moved(shapes::square(4),
                                                      [](const Vec3& p) {
                                                        return Vec3{p.x - 0.5, p.y, 0.0};
                                                      }),
                                        shapes::moved(shapes::square(4), [](const Vec3& p) {
                                          return Vec3{0.0, p.x, p.y};
                                        }));
  for (const TriangleMesh& part :
       {shapes::prism(l, {0.5, 0.5}), shapes::cylinder(32, 2, 2.0), shapes::torus(60, 24, 3.0, 1.0), tee, triangle}) {
    for (const std::int64_t quads : {100, 900}) {
      const MeshResult result = allQuad(part, quads);
      expectGood(result);
      EXPECT_EQ(result.quality.triangles, 0);
      const auto made = static_cast<double>(result.quality.quads);
      if (quads == 900) {
        EXPECT_NEAR(made, 900.0, 250.0) << part.positions.size();
      }
      std::int64_t reported = 0;
      for (const FaceReport& face : result.faces) reported += face.quads;
      EXPECT_EQ(reported, result.quality.quads);
    }
  }
}

TEST(MeshSurface, PairsTheLastTrianglesWhereThereShallBeNone) {
  // Tips of 12 degrees, where a row of elements ends in triangles.
  const TriangleMesh wedge = shapes::prism({{0, 0}, {8, 0}, {9.4, 1.5}, {8, 1.7}}, {6.0, 0.8});
  for (const std::int64_t quads : {60, 150, 400}) {
    const MeshResult any = mesh(wedge, quads);
    const MeshResult result = allQuad(wedge, quads);
    expectGood(result);
    EXPECT_GT(any.quality.triangles, 0) << quads;
    EXPECT_EQ(result.quality.triangles, 0) << quads;
    EXPECT_FALSE(result.elementsCut) << quads;
    EXPECT_LT(result.quality.quads, 1.3 * static_cast<double>(any.quality.quads + any.quality.triangles)) << quads;
    EXPECT_GT(result.quality.scaledJacobian.worst, 0.1) << quads;
  }
}

/// A square plate with a smooth spike thinner than an element.
TriangleMesh spikedPlate() {
  return shapes::moved(shapes::square(200), [](const Vec3& p) {
    const double r = std::min(1.0, distance(p, {0.47, 0.53, 0.0}) / 0.1);
    return Vec3{p.x, p.y, 0.15 * (1.0 + math::cos(math::kPi * r))};
  });
}

TEST(MeshSurface, MeasuresSizesByTheNumberAskedFor) {
  // A sphere takes fewer elements than its size field wants, so the front gets a smaller size to make up for that.
  const TriangleMesh sphere = shapes::moved(shapes::cubeSoup(16), [](const Vec3& p) {
    return normalized(p - Vec3{0.5, 0.5, 0.5});
  });
  double area = 0.0;
  for (const auto& t : sphere.triangles) {
    const auto corner = [&](std::size_t i) { return sphere.positions[static_cast<std::size_t>(t[i])]; };
    area += 0.5 * norm(cross(corner(1) - corner(0), corner(2) - corner(0)));
  }
  SilentProgress silent;
  MeshOptions options;
  options.quads = 1500;
  options.fitSizes = false;
  const auto made = meshSurface(sphere, options, silent);
  ASSERT_TRUE(made.ok());
  const MeshResult& result = made.value();
  expectGood(result);
  EXPECT_NEAR(static_cast<double>(result.quality.quads), 1500.0, 75.0);
  const double asked = std::sqrt(area / 1500.0);
  EXPECT_NEAR(result.size, asked, 1e-9 * asked);
  for (const double size : result.vertexSize) EXPECT_NEAR(size, asked, 1e-9 * asked);
  EXPECT_NEAR(result.sizeConformity.median, 1.0, 0.06);
}

TEST(MeshSurface, SettlesSizesInsideFaces) {
  const TriangleMesh sphere = shapes::moved(shapes::cubeSoup(16), [](const Vec3& p) {
    return normalized(p - Vec3{0.5, 0.5, 0.5});
  });
  SilentProgress silent;
  MeshOptions options;
  options.quads = 1500;
  const auto settled = meshSurface(sphere, options, silent);
  options.fitSizes = false;
  const auto even = meshSurface(sphere, options, silent);
  ASSERT_TRUE(settled.ok() && even.ok());
  expectGood(settled.value());
  EXPECT_TRUE(settled.value().fittedSizes);
  EXPECT_FALSE(even.value().fittedSizes);
  EXPECT_NEAR(static_cast<double>(settled.value().quality.quads), 1500.0, 75.0);
  // Squares on a sphere are smaller near the eight vertices that three of them share.
  EXPECT_GT(settled.value().quality.scaledJacobian.mean, even.value().quality.scaledJacobian.mean);
  EXPECT_LT(settled.value().sizeConformity.meanAbsLog2, 0.6 * even.value().sizeConformity.meanAbsLog2);
  // What a chord error asks for is an upper bound: 2 sqrt(2 E) on a sphere of radius 1.
  MeshOptions curved;
  curved.size = 0.15;
  curved.curvature = 0.0008;
  curved.fitSizes = true;
  const auto bound = meshSurface(sphere, curved, silent);
  ASSERT_TRUE(bound.ok());
  expectGood(bound.value());
  for (const double size : bound.value().vertexSize) EXPECT_LT(size, 1.03 * 0.08);
}

TEST(MeshSurface, PutsSmallerElementsWhereLargeOnesCanNotFollow) {
  const MeshResult result = mesh(spikedPlate(), 100);
  EXPECT_TRUE(result.quality.valid);
  EXPECT_GT(result.refinedPlaces, 0);
  double shortest = result.size;
  for (const Element& element : result.mesh.elements) {
    const Vec3& a = result.mesh.positions[static_cast<std::size_t>(element[0])];
    const Vec3& b = result.mesh.positions[static_cast<std::size_t>(element[1])];
    if (distance(a, {0.47, 0.53, a.z}) < 0.15) shortest = std::min(shortest, distance(a, b));
  }
  EXPECT_LT(shortest, 0.6 * result.size);
  EXPECT_EQ(mesh(shapes::cubeSoup(1), 600).refinedPlaces, 0);
}

/// A square of cells x cells with a side of that many units whose vertices are up to `height` off its plane, by lot.
TriangleMesh crumpledSheet(int cells, double height, std::uint64_t seed) {
  Random random(seed);
  return shapes::moved(shapes::square(cells), [&](const Vec3& p) {
    return Vec3{p.x * cells, p.y * cells, random.uniform(-height, height)};
  });
}

TEST(MeshSurface, TurnsElementsBackBeforeItGivesAFaceUp) {
  // Without creases, a few elements fall over in the folds; each of these meshes has some before they are mended, and
  // is made of the part's own triangles if they are not.
  SilentProgress silent;
  MeshOptions options;
  options.featureAngle = 179.0;
  for (const auto& [height, quads, seed] : {std::tuple{1.0, 150, 9U}, {1.3, 400, 2U}}) {
    options.quads = quads;
    options.trace = quads < 200;
    const auto result = meshSurface(crumpledSheet(12, height, seed), options, silent);
    ASSERT_TRUE(result.ok());
    EXPECT_TRUE(result.value().quality.valid) << seed;
    ASSERT_EQ(result.value().faces.size(), 1U);
    EXPECT_EQ(result.value().faces.front().method, "qmcf") << seed;
    if (options.trace) expectReplayed(result.value());
  }
}

TEST(MeshSurface, CoversARingThatTheSizeAskedForMisses) {
  // Elements of this size go straight through the ring; half as long ones, where these do, are enough.
  SilentProgress silent;
  const double area = 4.0 * math::kPi * math::kPi * 10.0 * 3.0;
  for (const bool allQuad : {false, true}) {
    MeshOptions options;
    options.size = allQuad ? 11.0 : 9.0;
    options.allQuad = allQuad;
    const auto result = meshSurface(shapes::torus(32, 16, 10.0, 3.0), options, silent);
    ASSERT_TRUE(result.ok());
    EXPECT_TRUE(result.value().quality.valid);
    EXPECT_GT(result.value().refinedPlaces, 0);
    EXPECT_GT(result.value().quality.area, 0.8 * area);
    EXPECT_LT(result.value().mesh.elements.size(), 650U);
  }
}

/// A plate of three by three cells with a second layer over the middle one, hardly above it.
TriangleMesh layeredPlate() {
  TriangleMesh plate = shapes::square(3);
  const auto vertexAt = [&plate](double x, double y) {
    for (std::size_t v = 0; v < plate.positions.size(); ++v) {
      if (distance(plate.positions[v], {x, y, 0.0}) < 1e-9) return static_cast<std::int32_t>(v);
    }
    return kNone;
  };
  const auto top = static_cast<std::int32_t>(plate.positions.size());
  plate.positions.push_back({0.5, 0.5, 0.01});
  const std::array<std::int32_t, 4> cell{vertexAt(1. / 3, 1. / 3), vertexAt(2. / 3, 1. / 3), vertexAt(2. / 3, 2. / 3),
                                         vertexAt(1. / 3, 2. / 3)};
  for (std::size_t i = 0; i < 4; ++i) plate.triangles.push_back({cell[i], cell[(i + 1) % 4], top});
  return plate;
}

TEST(MeshSurface, MeshesOneOfTwoLayersThatElementsCanNotTellApart) {
  const MeshResult result = mesh(layeredPlate(), 100);
  expectGood(result);
  const auto omitted = std::count_if(result.faces.begin(), result.faces.end(),
                                     [](const FaceReport& face) { return face.method == "omitted"; });
  EXPECT_EQ(omitted, 1);
  for (const FaceReport& face : result.faces) EXPECT_EQ(face.method == "omitted", !face.reason.empty());
}

/// A plate of cells x cells squares, all but the outermost with a second layer hardly above them. One of the two faces
/// down: by turns the lower one and the upper one.
TriangleMesh plateOfPillows(int cells) {
  TriangleMesh plate;
  const auto vertexAt = [cells](int i, int j) { return static_cast<std::int32_t>(i * (cells + 1) + j); };
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) plate.positions.push_back({i / 10.0, j / 10.0, 0.0});
  }
  const auto isInside = [cells](int i) { return i > 0 && i + 1 < cells; };
  for (const bool isUpper : {false, true}) {
    for (int i = 0; i < cells; ++i) {
      for (int j = 0; j < cells; ++j) {
        const bool hasTwo = isInside(i) && isInside(j);
        if (isUpper && !hasTwo) continue;
        const std::array<std::int32_t, 4> cell{vertexAt(i, j), vertexAt(i + 1, j), vertexAt(i + 1, j + 1),
                                               vertexAt(i, j + 1)};
        const bool facesDown = hasTwo && ((i + j) % 2 == 0) != isUpper;
        const auto middle = static_cast<std::int32_t>(plate.positions.size());
        plate.positions.push_back({(i + 0.5) / 10.0, (j + 0.5) / 10.0, isUpper ? 3e-3 : 0.0});
        for (std::size_t k = 0; k < 4; ++k) {
          plate.triangles.push_back({cell[k], cell[(k + 1) % 4], middle});
          if (facesDown) std::swap(plate.triangles.back()[0], plate.triangles.back()[1]);
        }
      }
    }
  }
  return plate;
}

TEST(MeshSurface, TurnsAsManyLayersAsDisagreeWithTheFacesAround) {
  // Where there are two layers all around, neither of them agrees better than the other.
  const MeshResult result = mesh(plateOfPillows(11), 500);
  for (const ValidityCheck& check : result.quality.checks) {
    // Most of the part has one layer less.
    EXPECT_EQ(check.status == CheckStatus::fail, check.name == "coverage") << check.name << ": " << check.sentence;
  }
  const auto omitted = std::count_if(result.faces.begin(), result.faces.end(),
                                     [](const FaceReport& face) { return face.method == "omitted"; });
  EXPECT_EQ(omitted, 81);
}

TEST(MeshSurface, PutsNodesAcrossFromEachOtherOnBothSidesOfACrack) {
  // The crack is wider than what repair joins.
  for (const std::int64_t quads : {50, 100, 200, 400}) expectGood(mesh(parts::crackedSquare(6e-6), quads));
}

/// A triangular plate with a flat pyramid over the triangle in its middle.
TriangleMesh plateWithPyramid(double height) {
  TriangleMesh plate;
  for (const double radius : {1.0, 4.0}) {
    for (int i = 0; i < 3; ++i) {
      const auto corner = math::unitComplex(2.0 * math::kPi * i / 3.0);
      plate.positions.push_back({radius * corner.real(), radius * corner.imag(), 0.0});
    }
  }
  plate.positions.push_back({0.0, 0.0, height});
  for (std::int32_t i = 0; i < 3; ++i) {
    const std::int32_t j = (i + 1) % 3;
    plate.triangles.push_back({i, j, 6});
    plate.triangles.push_back({i, i + 3, j + 3});
    plate.triangles.push_back({i, j + 3, j});
  }
  plate.triangles.push_back({0, 1, 2});
  return plate;
}

TEST(MeshSurface, MakesTwoLayersOfTheSameElementAnotherWay) {
  // Neither layer is wide enough for more than one triangle; the pyramid's own three are not that of the plate.
  MeshOptions options;
  options.size = 2.0;
  options.featureAngle = 170.0;
  SilentProgress silent;
  for (const double height : {0.55, 0.7}) {
    const auto result = meshSurface(plateWithPyramid(height), options, silent);
    ASSERT_TRUE(result.ok());
    EXPECT_TRUE(result.value().quality.valid) << height;
    const auto isPyramid = [](const FaceReport& face) { return face.method == "given" && face.triangles == 3; };
    EXPECT_EQ(std::count_if(result.value().faces.begin(), result.value().faces.end(), isPyramid), 1) << height;
  }
}

TEST(MeshSurface, MeshesBothOfTwoLayersWithQuadrilateralsOnly) {
  for (const std::int64_t quads : {40, 100}) {
    const MeshResult result = allQuad(layeredPlate(), quads);
    expectGood(result);
    EXPECT_EQ(result.quality.triangles, 0);
    for (const FaceReport& face : result.faces) EXPECT_TRUE(face.reason.empty()) << face.reason;
    EXPECT_TRUE(result.elementsCut);  // Layers that share elements can't be told apart, cut ones can.
  }
}

TEST(MeshSurface, GivesTheSameBytesEachTime) {
  const MeshResult first = mesh(shapes::cylinder(32, 2, 2.0), 800);
  const MeshResult second = mesh(shapes::cylinder(32, 2, 2.0), 800);
  EXPECT_EQ(first.mesh.elements, second.mesh.elements);
  EXPECT_TRUE(first.mesh.positions == second.mesh.positions);
}

/// Flat, curved, closed and refined faces.
std::vector<TriangleMesh> severalParts() {
  const std::vector<Vec2> l{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  return {shapes::prism(l, {0.5, 0.5}), shapes::cylinder(48, 1, 4.0), shapes::torus(60, 24, 3.0, 1.0), spikedPlate()};
}

TEST(MeshSurface, GivesTheSameBytesWithAnyNumberOfThreads) {
  for (const TriangleMesh& part : severalParts()) {
    for (const Mode mode : {Mode::qmcf, Mode::qmorph}) {
      std::optional<MeshResult> alone;
      for (const std::int64_t threads : {1, 2, 7}) {
        SilentProgress silent;
        MeshOptions options;
        options.quads = 500;
        options.mode = mode;
        options.allQuad = mode == Mode::qmcf;
        options.threads = threads;
        auto result = meshSurface(part, options, silent);
        ASSERT_TRUE(result.ok());
        if (!alone) {
          alone = std::move(result).value();
          continue;
        }
        EXPECT_EQ(result.value().mesh.elements, alone->mesh.elements);
        EXPECT_TRUE(result.value().mesh.positions == alone->mesh.positions);
        EXPECT_EQ(toJson(result.value()), toJson(*alone));
      }
    }
  }
}

TEST(MeshSurface, CanBeCancelledAtAnyReportWithSeveralThreads) {
  class StopAfter final : public Progress {
   public:
    explicit StopAfter(int calls) : left_(calls) {}
    [[nodiscard]] bool report(Stage, double) override {
      EXPECT_FALSE(stopped);
      stopped = left_-- == 0;
      return !stopped;
    }
    bool stopped = false;

   private:
    int left_;
  };
  const TriangleMesh part = shapes::prism({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, {0.5, 0.5});
  int finished = 0;
  for (int calls = 0; finished < 3; calls += 9) {
    StopAfter progress(calls);
    MeshOptions options;
    options.quads = 400;
    options.threads = 4;
    const auto result = meshSurface(part, options, progress);
    EXPECT_EQ(result.ok(), !progress.stopped);
    if (result.ok()) {
      ++finished;
    } else {
      EXPECT_EQ(result.error().code, ErrorCode::cancelled);
    }
  }
}

TEST(MeshSurface, RecordsHowEachFaceWasMeshed) {
  for (const TriangleMesh& part : severalParts()) {
    for (const auto& [mode, allQuad] : {std::pair{Mode::qmcf, false}, {Mode::qmorph, false}, {Mode::qmcf, true}}) {
      SilentProgress silent;
      MeshOptions options;
      options.quads = 300;
      options.mode = mode;
      options.allQuad = allQuad;
      const auto plain = meshSurface(part, options, silent);
      options.trace = true;
      const auto traced = meshSurface(part, options, silent);
      options.threads = 3;
      const auto again = meshSurface(part, options, silent);
      ASSERT_TRUE(plain.ok() && traced.ok() && again.ok());
      EXPECT_FALSE(plain.value().trace.has_value());
      EXPECT_EQ(toJson(traced.value()), toJson(plain.value()));
      EXPECT_EQ(traceJson(again.value()), traceJson(traced.value()));
      expectReplayed(traced.value());
    }
  }
}

TEST(MeshSurface, MeshesASingleTriangle) {
  TriangleMesh triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  for (const std::int64_t quads : {1, 10, 300}) EXPECT_TRUE(mesh(triangle, quads).quality.valid) << quads;
}

TEST(MeshSurface, RefusesOptionsOutOfRange) {
  SilentProgress silent;
  const std::vector<std::function<void(MeshOptions&)>> mistakes{
      [](MeshOptions& o) { o.size = -1.0; },        [](MeshOptions& o) { o.size = 0.0; },
      [](MeshOptions& o) { o.quads = 0; },          [](MeshOptions& o) { o.quads = 20'000'000; },
      [](MeshOptions& o) { o.featureAngle = 0.0; }, [](MeshOptions& o) { o.featureAngle = 180.0; },
      [](MeshOptions& o) { o.gradation = 0.0; },    [](MeshOptions& o) { o.size = 1.0, o.quads = 10; },
      [](MeshOptions& o) { o.threads = 0; },        [](MeshOptions& o) { o.threads = 257; },
  };
  for (std::size_t i = 0; i < mistakes.size(); ++i) {
    MeshOptions options;
    mistakes[i](options);
    const auto result = meshSurface(shapes::square(2), options, silent);
    ASSERT_FALSE(result.ok()) << i;
    EXPECT_EQ(result.error().code, ErrorCode::invalidOption);
    EXPECT_FALSE(result.error().message.empty());
  }
}

TEST(MeshSurface, CanBeCancelledInEveryStage) {
  class StopAt final : public Progress {
   public:
    explicit StopAt(Stage stage) : stage_(stage) {}
    [[nodiscard]] bool report(Stage stage, double) override {
      reached = reached || stage == stage_;
      return stage != stage_;
    }
    bool reached = false;

   private:
    Stage stage_;
  };
  for (const Stage stage : {Stage::repair, Stage::topology, Stage::sizing, Stage::background, Stage::field,
                            Stage::front, Stage::cleanup, Stage::quality}) {
    StopAt stop(stage);
    MeshOptions options;
    options.quads = 300;
    options.threads = 1;  // Or another thread might report the stage, which is told to nobody.
    const auto result = meshSurface(shapes::cylinder(24, 4, 2.0), options, stop);
    EXPECT_TRUE(stop.reached) << stageName(stage);
    ASSERT_FALSE(result.ok()) << stageName(stage);
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
  }
}

TEST(MeshSurface, MeshesBySizesAtTheVerticesOfTheInput) {
  SilentProgress silent;
  // Six sheets that share no vertex: where they meet, the smallest of their sizes holds.
  const TriangleMesh part = shapes::cubeSoup(4);
  MeshOptions options;
  for (const Vec3& p : part.positions) options.sizes.push_back(0.04 + 0.08 * p.x);
  for (std::size_t v = 0; v < part.positions.size() / 6; ++v) options.sizes[v] += 0.01;
  const auto result = meshSurface(part, options, silent);
  ASSERT_TRUE(result.ok()) << result.error().message;
  expectGood(result.value());
  EXPECT_GT(result.value().sizing.bySizes, 50);
  EXPECT_LT(result.value().sizeConformity.meanAbsLog2, 0.35);
  ASSERT_EQ(result.value().vertexSize.size(), part.positions.size());
  for (std::size_t v = 0; v < part.positions.size(); ++v) {
    EXPECT_NEAR(result.value().vertexSize[v], 0.04 + 0.08 * part.positions[v].x, 0.0101);
  }
  // What was written leads to the same field.
  MeshOptions again;
  again.sizes = result.value().vertexSize;
  const auto second = meshSurface(part, again, silent);
  ASSERT_TRUE(second.ok());
  for (std::size_t v = 0; v < part.positions.size(); ++v) {
    EXPECT_NEAR(second.value().vertexSize[v], result.value().vertexSize[v], 1e-9);
  }
}

TEST(MeshSurface, KeepsChordsNearCurvedFaces) {
  SilentProgress silent;
  const TriangleMesh part = shapes::torus(120, 60, 3.0, 1.0);
  MeshOptions options;
  options.size = 1.0;
  const auto coarse = meshSurface(part, options, silent);
  options.curvature = 0.02;
  for (const bool allQuad : {false, true}) {
    options.allQuad = allQuad;
    const auto fine = meshSurface(part, options, silent);
    ASSERT_TRUE(coarse.ok() && fine.ok());
    expectGood(fine.value());
    // Edges come out up to a third longer than the size, the middle of a quad is twice as far as that of an edge.
    EXPECT_LT(*fine.value().quality.largestDistance, 4.0 * 0.02) << allQuad;
    EXPECT_LT(*fine.value().quality.meanDistance, 0.3 * *coarse.value().quality.meanDistance) << allQuad;
    EXPECT_GT(fine.value().sizing.byCurvature, 0);
  }
}

/// The sector of a ring with radii 1 and 2, 90 degrees wide.
TriangleMesh sector() {
  return shapes::grid(60, 20, [](double u, double v) {
    const double angle = 0.5 * std::numbers::pi * (1.0 - u);
    return Vec3{(1.0 + v) * std::cos(angle), (1.0 + v) * std::sin(angle), 0.0};
  });
}

TEST(MeshSurface, FitsSizesToTheFieldWhereThatIsBetter) {
  SilentProgress silent;
  for (const std::int64_t quads : {800, 1000}) {
    MeshOptions options;
    options.quads = quads;
    const auto fitted = meshSurface(sector(), options, silent);
    options.fitSizes = false;
    const auto even = meshSurface(sector(), options, silent);
    ASSERT_TRUE(even.ok() && fitted.ok());
    for (const auto* const result : {&even, &fitted}) expectGood(result->value());
    EXPECT_FALSE(even.value().fittedSizes);
    EXPECT_TRUE(fitted.value().fittedSizes);
    const QualityReport& better = fitted.value().quality;
    EXPECT_LT(better.irregularVertices, even.value().quality.irregularVertices);
    EXPECT_LT(better.jacobianRatio.mean, even.value().quality.jacobianRatio.mean);
    EXPECT_NEAR(static_cast<double>(better.quads), static_cast<double>(quads), 0.05 * static_cast<double>(quads));
    EXPECT_NEAR(fitted.value().size, even.value().size, 0.02 * even.value().size);
    const auto [least, most] = std::minmax_element(fitted.value().vertexSize.begin(), fitted.value().vertexSize.end());
    EXPECT_GT(*most, 1.3 * *least);
    EXPECT_LT(*most, 1.5 * *least);
  }
  // A size is taken at its word, unless it need not be.
  MeshOptions sized;
  sized.size = 0.04;
  const auto asked = meshSurface(sector(), sized, silent);
  sized.fitSizes = true;
  const auto allowed = meshSurface(sector(), sized, silent);
  ASSERT_TRUE(asked.ok() && allowed.ok());
  EXPECT_FALSE(asked.value().fittedSizes);
  EXPECT_TRUE(allowed.value().fittedSizes);
  EXPECT_LT(allowed.value().quality.irregularVertices, asked.value().quality.irregularVertices);
  // Of many elements the field is that of fewer.
  MeshOptions options;
  options.quads = 6000;
  const auto many = meshSurface(sector(), options, silent);
  ASSERT_TRUE(many.ok());
  EXPECT_TRUE(many.value().fittedSizes);
  EXPECT_NEAR(static_cast<double>(many.value().quality.quads), 6000.0, 300.0);
  // On a plate whose field does not turn there is nothing to fit.
  const auto plate = meshSurface(shapes::square(8), options, silent);
  ASSERT_TRUE(plate.ok());
  EXPECT_FALSE(plate.value().fittedSizes);
}

TEST(MeshSurface, RefusesSizesThatFitNothing) {
  SilentProgress silent;
  const TriangleMesh part = shapes::cubeSoup(1);
  std::vector<MeshOptions> bad(6);
  bad[4].fitSizes = true;
  bad[4].mode = Mode::qmorph;
  bad[5].fitSizes = true;
  bad[5].sizes.assign(part.positions.size(), 0.2);
  bad[0].sizes = {1.0, 2.0};
  bad[1].sizes.assign(part.positions.size(), 0.2);
  bad[1].quads = 100;
  bad[2].sizes.assign(part.positions.size(), 0.2);
  bad[2].sizes[5] = -1.0;
  bad[3].curvature = HUGE_VAL;
  for (const MeshOptions& options : bad) {
    const auto result = meshSurface(part, options, silent);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::invalidOption);
  }
  EXPECT_EQ(validateOptions(bad[2])->elements, std::vector<std::int64_t>{5});
}

}  // namespace
}  // namespace qmcf
