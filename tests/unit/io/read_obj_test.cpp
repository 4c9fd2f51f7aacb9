#include <array>
#include <limits>

#include "io_support.hpp"

namespace qmcf {
namespace {

constexpr std::string_view kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

using Triangles = std::vector<std::array<std::int32_t, 3>>;

std::string withSquare(std::string_view rest) { return std::string(kSquare) + std::string(rest); }

TEST(ReadObj, ReadsAllFormsOfCorners) {
  for (const std::string_view face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/3/1",
                                      "f -4 -3 -2", "f -4/-1/-2 -3/-1/-2 -2/-1/-2", "  f\t1 2\t 3  ", "f +1 2/ 3//"}) {
    const ReadModel model = readOk(withSquare(face));
    EXPECT_EQ(model.mesh.triangles, (Triangles{{0, 1, 2}})) << face;
    EXPECT_EQ(model.format, InputFormat::obj);
    EXPECT_EQ(model.polygons, 1);
  }
}

TEST(ReadObj, NegativeIndicesCountFromTheVerticesSoFar) {
  const ReadModel model = readOk("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -4 -3 -1\n");
  EXPECT_EQ(model.mesh.triangles, (Triangles{{0, 1, 2}, {0, 1, 3}}));
}

TEST(ReadObj, AcceptsFacesBeforeTheirVertices) {
  EXPECT_EQ(readOk(std::string("f 1 2 3\n") + std::string(kSquare)).mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST(ReadObj, AcceptsAnyLineEndAndByteOrderMark) {
  for (const std::string_view end : {"\n", "\r", "\r\n"}) {
    std::string text = "\xef\xbb\xbf# a comment that ends in a backslash \\" + std::string(end);
    for (const std::string_view line : {"v 0 0 0", "v 1 0 0 0.5 0.5 0.5", "", "v 1 1 0", "f 1 \\"})
      text += std::string(line) + std::string(end);
    text += "2 3" + std::string(end);
    const ReadModel model = readOk(text);
    EXPECT_EQ(model.mesh.positions.size(), 3U);
    EXPECT_EQ(model.mesh.triangles, (Triangles{{0, 1, 2}}));
  }
}

TEST(ReadObj, VerticesOfTwoCoordinatesLieInThePlane) {
  const ReadModel model = readOk("v 1 2\nv 3 2 # x and y\nv 1 5\nf 1 2 3\n");
  EXPECT_EQ(model.mesh.positions, (std::vector<Vec3>{{1, 2, 0}, {3, 2, 0}, {1, 5, 0}}));
  expectError("v 1\nv 0 1\nv 1 1\nf 1 2 3\n", ErrorCode::malformedInput, "Line 1");
}

TEST(ReadObj, ReadsNumbersExactly) {
  const ReadModel model =
      readOk("v .1 -1.e-3 +2E2\nv 4.9406564584124654e-324 1e-400 1.7976931348623157e308\nv 0.1 0 -0\nf 1 2 3\n");
  EXPECT_EQ(model.mesh.positions[0], (Vec3{0.1, -0.001, 200.0}));
  EXPECT_EQ(model.mesh.positions[1],
            (Vec3{std::numeric_limits<double>::denorm_min(), 0.0, std::numeric_limits<double>::max()}));
}

TEST(ReadObj, KeepsGroupsObjectsAndMaterialsAsLabels) {
  const ReadModel model = readOk(withSquare(
      "f 1 2 3\no part\ng top side\nf 1 2 3\nusemtl steel\nf 1 3 4\ng\nusemtl\nf 1 2 4\ng top side\nf 1 2 3 4\n"));
  EXPECT_EQ(model.mesh.labelNames,
            (std::vector<std::string>{"default", "part/top side", "part/top side/steel", "part"}));
  EXPECT_EQ(model.mesh.labels, (std::vector<std::int32_t>{0, 1, 2, 3, 1, 1}));
}

TEST(ReadObj, HasNoLabelsWithoutGroups) { EXPECT_TRUE(readOk(withSquare("f 1 2 3\n")).mesh.labels.empty()); }

TEST(ReadObj, MakesNamesValidUtf8) {
  const ReadModel model =
      readOk(withSquare("g Gr\xc3\xb6\xc3\x9f"
                        "e\nf 1 2 3\ng Gr\xf6\xdf"
                        "e\x01!\nf 1 2 4\n"));
  EXPECT_EQ(model.mesh.labelNames, (std::vector<std::string>{"Gr\xc3\xb6\xc3\x9f"
                                                             "e",
                                                             "Gr\xc3\xb6\xc3\x9f"
                                                             "e !"}));
}

TEST(ReadObj, BoundsTheMemoryOfNames) {
  std::string text = std::string(kSquare) + "o " + std::string(150, 'x') + "\n";
  for (int i = 0; i < 5000; ++i) text += "g " + std::to_string(i) + "\nf 1 2 3\n";
  const ReadModel model = readOk(text);
  std::size_t total = 0;
  for (const std::string& name : model.mesh.labelNames) total += name.size();
  EXPECT_EQ(model.mesh.labelNames.size(), 5000U);
  EXPECT_LT(total, 3 * text.size());
}

TEST(ReadObj, CountsFacesItLeavesOut) {
  const ReadModel model = readOk(withSquare("f 1 2\nf 1 2 3\nf\n"));
  EXPECT_EQ(model.skippedFaces, 2);
  EXPECT_EQ(model.mesh.triangles.size(), 1U);
}

TEST(ReadObj, IgnoresWhatItDoesNotKnow) {
  EXPECT_EQ(readOk(withSquare("vt 0 0\nvn nan 0 1\ns off\nmtllib C:\\parts\\\nf 1 2 3\ncurv 0 1\nvertex 1\n"))
                .mesh.triangles.size(),
            1U);
}

TEST(ReadObj, NamesTheLineOfAnIndexOutOfRange) {
  expectError(withSquare("f 1 2 3\nf 1 2 9\nf 1 2 12\nf 1 3 4\n"), ErrorCode::indexOutOfRange, "Line 6: vertex 9");
  expectError(withSquare("f 1 2 0\n"), ErrorCode::indexOutOfRange, "Line 5");
  expectError(withSquare("f 1 2 -5\n"), ErrorCode::indexOutOfRange, "Line 5");
  expectError(withSquare("\n\nf 1 2 99999999999999999999999\n"), ErrorCode::indexOutOfRange, "Line 7");
  const Result<ReadModel> model = read(withSquare("f 1 2 9\n"));
  EXPECT_EQ(model.error().elements, (std::vector<std::int64_t>{5}));
}

TEST(ReadObj, NamesTheLineOfANonFiniteCoordinate) {
  for (const std::string_view value : {"nan", "NaN", "-nan(ind)", "inf", "-Infinity", "1e999", "1.#QNAN", "-1.#IND"}) {
    expectError("v 0 0 0\r\nv 1 " + std::string(value) + " 0\r\nv 0 1 0\r\nf 1 2 3\r\n", ErrorCode::nonFiniteCoordinate,
                "Line 2");
  }
}

TEST(ReadObj, NamesTheLineThatItCannotUnderstand) {
  expectError("v 0 0 0\nv 1,5 0 0\nf 1 2 1\n", ErrorCode::malformedInput, "Line 2: the coordinate \"1,5\"");
  expectError("v 0\nf 1 1 1\n", ErrorCode::malformedInput, "Line 1");
  expectError(withSquare("f 1 2 3x\n"), ErrorCode::malformedInput, "Line 5");
  expectError(withSquare("f 1 2 three\n"), ErrorCode::malformedInput, "\"three\"");
  expectError("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nv 2", ErrorCode::malformedInput, "Line 5");
}

TEST(ReadObj, SaysWhenThereIsNothing) {
  expectError("", ErrorCode::emptyInput, "empty");
  expectError(" \n\r\n# only this\n", ErrorCode::emptyInput, "no data");
  expectError(kSquare, ErrorCode::emptyInput, "4 vertices but no face");
}

TEST(ReadObj, StopsWhenAskedTo) {
  class Stop final : public Progress {
   public:
    bool report(Stage stage, double /*fraction*/) override { return stage != Stage::read; }
  } stop;
  const Result<ReadModel> model = readModel(bytesOf(withSquare("f 1 2 3\n")), stop);
  ASSERT_FALSE(model.ok());
  EXPECT_EQ(model.error().code, ErrorCode::cancelled);
}

TEST(DetectFormat, NamesFormatsThatCannotBeRead) {
  expectError("ISO-10303-21;\nHEADER;\n", ErrorCode::unknownFormat, "STEP");
  expectError("OFF\n3 1 0\n", ErrorCode::unknownFormat, "OFF");
  expectError(std::string_view("PK\x03\x04\x14\x00\x00\x00", 8), ErrorCode::unknownFormat, "ZIP");
  expectError("hello world\n", ErrorCode::unknownFormat, "neither OBJ nor STL nor PLY");
  expectError(std::string(300, '\0'), ErrorCode::unknownFormat, "neither OBJ nor STL nor PLY");
}

TEST(ReadQuadMesh, KeepsQuadrilateralsGroupsAndLines) {
  const Result<QuadMesh> mesh = readQuads(withSquare("v 2 0 0\ng a\nf 1 2 3 4\ng b\nf 2 5 3\ng rim\nl 1 2 5\n"));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh.value().elements, (std::vector<Element>{{0, 1, 2, 3}, {1, 4, 2, kNone}}));
  EXPECT_EQ(mesh.value().elementFace, (std::vector<std::int32_t>{0, 1}));
  ASSERT_EQ(mesh.value().featureSegments.size(), 2U);
  EXPECT_EQ(mesh.value().featureSegments[1].b, 4);
}

TEST(ReadQuadMesh, RefusesLargerPolygonsAndStl) {
  const Result<QuadMesh> pentagon = readQuads(withSquare("v 0 2 0\nf 1 2 3\nf 1 2 3 4 5\n"));
  ASSERT_FALSE(pentagon.ok());
  EXPECT_EQ(pentagon.error().elements, (std::vector<std::int64_t>{1}));
  EXPECT_EQ(readQuads(binaryStl(1)).error().code, ErrorCode::unknownFormat);
}

}  // namespace
}  // namespace qmcf
