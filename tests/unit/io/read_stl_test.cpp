#include <limits>

#include "io_support.hpp"

namespace qmcf {
namespace {

constexpr std::string_view kFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";

std::string solid(std::string_view name, int facets) {
  std::string text = "solid " + std::string(name) + "\n";
  for (int i = 0; i < facets; ++i) text += kFacet;
  return text + "endsolid " + std::string(name) + "\n";
}

TEST(ReadStl, ReadsAscii) {
  const ReadModel model = readOk(solid("part", 2));
  EXPECT_EQ(model.format, InputFormat::stlAscii);
  EXPECT_EQ(model.polygons, 2);
  ASSERT_EQ(model.mesh.positions.size(), 6U);
  EXPECT_EQ(model.mesh.positions[4], (Vec3{1.0, 0.0, 0.0}));
  EXPECT_EQ(areaVector(model.mesh, 1), (Vec3{0.0, 0.0, 0.5}));
  EXPECT_EQ(model.mesh.labelNames, std::vector<std::string>{"part"});
}

TEST(FileVertices, AreTheDifferentPointsOfAnStlAndTheVerticesOfAnObj) {
  const ReadModel model = readOk(
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
      "facet normal 0 0 1\nouter loop\nvertex -0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n");
  EXPECT_EQ(fileVertices(model), (std::vector<std::int32_t>{0, 1, 2, 0, 2, 3}));
  const ReadModel twice = readOk("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n");
  EXPECT_EQ(fileVertices(twice), (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5}));
}

TEST(ReadStl, ReadsAsciiOfAnyCaseAndLayout) {
  const ReadModel model = readOk(
      "SOLID\r\nFACET NORMAL nan nan nan\r\nOUTER LOOP\r\nVERTEX 0 0 0 VERTEX 1 0 0\r\nVertex 0 1 "
      "0\r\nENDLOOP\r\nENDFACET\r\nENDSOLID");
  EXPECT_EQ(model.mesh.triangles.size(), 1U);
  EXPECT_TRUE(model.mesh.labels.empty());
}

TEST(ReadStl, LabelsSeveralSolids) {
  const ReadModel model = readOk(solid("a b", 1) + solid("", 2) + solid("empty", 0) + solid("a b", 1));
  EXPECT_EQ(model.mesh.labelNames, (std::vector<std::string>{"a b", "solid 2", "a b"}));
  EXPECT_EQ(model.mesh.labels, (std::vector<std::int32_t>{0, 1, 1, 2}));
}

TEST(ReadStl, ReadsBinaryWhateverItsHeaderSays) {
  for (const char* header : {"made by a test", "solid pretends to be text", "facet normal 0 0 1"}) {
    const ReadModel model = readOk(binaryStl(3, header));
    EXPECT_EQ(model.format, InputFormat::stlBinary);
    ASSERT_EQ(model.mesh.triangles.size(), 3U);
    EXPECT_EQ(model.mesh.positions[7], (Vec3{3.0, 2.0, 0.0}));
  }
}

TEST(ReadStl, ReadsBinaryWithTrailingBytes) {
  EXPECT_EQ(readOk(binaryStl(3, "solid") + std::string(7, '\0')).mesh.triangles.size(), 3U);
}

TEST(ReadStl, SaysWhatATruncatedFileMisses) {
  const std::string whole = binaryStl(20);
  expectError(whole.substr(0, whole.size() - 1), ErrorCode::truncatedInput, "announces 20 triangles but ends after 19");
  expectError(whole.substr(0, 90), ErrorCode::truncatedInput, "ends after 0");
  const std::string text = solid("part", 3);
  for (const std::size_t end :
       {text.rfind("endsolid"), text.rfind("endfacet"), text.rfind("vertex"), text.rfind("0 1 0") + 1}) {
    expectError(text.substr(0, end), ErrorCode::truncatedInput,
                end == text.rfind("endsolid") ? "endsolid" : "triangle 3");
  }
}

TEST(ReadStl, DoesNotTrustTheCount) {
  std::string bytes = binaryStl(2);
  for (std::size_t i = 80; i < 84; ++i) bytes[i] = '\xff';
  expectError(bytes, ErrorCode::truncatedInput, "4294967295");
}

TEST(ReadStl, NamesTheTriangleOfANonFiniteCoordinate) {
  std::string bytes = binaryStl(3);
  std::string nan;
  appendFloat(nan, std::numeric_limits<float>::quiet_NaN());
  bytes.replace(84 + 2 * 50 + 12, 4, nan);
  expectError(bytes, ErrorCode::nonFiniteCoordinate, "Triangle 2");
  EXPECT_EQ(read(bytes).error().elements, (std::vector<std::int64_t>{2}));

  std::string text = solid("part", 2);
  text.replace(text.rfind("0 1 0"), 5, "0 inf 0");
  expectError(text, ErrorCode::nonFiniteCoordinate, "Line 13");
}

TEST(ReadStl, NamesTheLineThatItCannotUnderstand) {
  std::string text = solid("part", 2);
  text.replace(text.rfind("endloop"), 7, "vertex 1 1 1 endloop");
  expectError(text, ErrorCode::malformedInput, "Line 14: expected \"endloop\" but found \"vertex\"");
  expectError("solid a\nfacet normal 0 0 1\nvertex 0 0 0\n", ErrorCode::malformedInput, "Line 3");
  expectError("solid a\nnonsense\n", ErrorCode::malformedInput, "\"nonsense\"");
}

TEST(ReadStl, SaysWhenThereIsNothing) {
  expectError(binaryStl(0), ErrorCode::emptyInput, "no face");
  expectError("solid nothing\nendsolid nothing\n", ErrorCode::emptyInput, "no face");
}

}  // namespace
}  // namespace qmcf
