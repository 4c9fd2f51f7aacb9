#include <limits>

#include "io_support.hpp"

namespace qmcf {
namespace {

std::string header(std::string_view format, std::string_view elements) {
  return "ply\nformat " + std::string(format) + " 1.0\ncomment made by a test\n" + std::string(elements) +
         "end_header\n";
}

constexpr std::string_view kElements =
    "element material 2\nproperty uchar red\nproperty list ushort double extra\n"
    "element vertex 4\nproperty double x\nproperty short flags\nproperty float y\nproperty int z\n"
    "element face 2\nproperty uint8 quality\nproperty list uchar uint vertex_indices\nproperty int label\n";

/// A square as one quadrilateral and one triangle, with values of many types and a foreign element before them.
std::string binaryPly(bool bigEndian) {
  std::string out = header(bigEndian ? "binary_big_endian" : "binary_little_endian", kElements);
  for (const std::uint16_t count : {std::uint16_t{2}, std::uint16_t{0}}) {
    append(out, std::uint8_t{255});
    append(out, count, bigEndian);
    for (std::uint16_t i = 0; i < count; ++i) appendDouble(out, 1e300, bigEndian);
  }
  const double xy[4][2] = {{0.1, 0.0}, {1.0, 0.0}, {1.0, 1.5}, {0.0, 1.0}};
  for (const auto& [x, y] : xy) {
    appendDouble(out, x, bigEndian);
    append(out, static_cast<std::uint16_t>(-7), bigEndian);
    appendFloat(out, static_cast<float>(y), bigEndian);
    append(out, static_cast<std::uint32_t>(-3), bigEndian);
  }
  const std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2, 3}, {0, 1, 2}};
  for (const auto& face : faces) {
    append(out, std::uint8_t{1});
    append(out, static_cast<std::uint8_t>(face.size()));
    for (const std::uint32_t corner : face) append(out, corner, bigEndian);
    append(out, face.size() == 4 ? 70U : 20U, bigEndian);
  }
  return out;
}

const std::string kAsciiPly = header("ascii", kElements) +
                              "255 2 1e300 1e300\n255 0\n"
                              "0.1 -7 0 -3\n1 -7 0 -3\n1 -7 1.5 -3\n0 -7 1 -3\n"
                              "1 4 0 1 2 3 70\n1 3 0 1 2 20\n";

TEST(ReadPly, ReadsTheSameFromEveryEncoding) {
  for (const std::string& text : {kAsciiPly, binaryPly(false), binaryPly(true)}) {
    const ReadModel model = readOk(text);
    EXPECT_EQ(model.format, InputFormat::ply);
    EXPECT_EQ(model.polygons, 2);
    ASSERT_EQ(model.mesh.positions.size(), 4U);
    EXPECT_EQ(model.mesh.positions[0], (Vec3{0.1, 0.0, -3.0}));
    EXPECT_EQ(model.mesh.positions[2], (Vec3{1.0, 1.5, -3.0}));
    EXPECT_EQ(model.mesh.triangles.size(), 3U);
    EXPECT_EQ(model.mesh.labels, (std::vector<std::int32_t>{0, 0, 1}));
    EXPECT_EQ(model.mesh.labelNames, (std::vector<std::string>{"face 70", "face 20"}));
  }
}

TEST(ReadPly, AcceptsAnyLineEndInTheHeader) {
  for (const std::string_view end : {"\n", "\r", "\r\n"}) {
    std::string text;
    for (const char c : header("binary_little_endian",
                               "element vertex 3\nproperty char x\nproperty char y\nproperty char z\nelement face "
                               "1\nproperty list uchar uchar vertex_index\n")) {
      if (c == '\n') {
        text += end;
      } else {
        text += c;
      }
    }
    // The first coordinate looks like a line feed.
    for (const int value : {10, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 1, 2}) text += static_cast<char>(value);
    EXPECT_EQ(readOk(text).mesh.positions[0].x, 10.0);
  }
}

TEST(ReadPly, TruncatedAnywhereIsAnError) {
  for (const std::string& text : {binaryPly(false), binaryPly(true), kAsciiPly.substr(0, kAsciiPly.rfind(' '))}) {
    for (std::size_t size = 4; size < text.size(); ++size) {
      const Result<ReadModel> model = read(std::string_view(text).substr(0, size));
      ASSERT_FALSE(model.ok()) << size;
      const ErrorCode code = model.error().code;
      EXPECT_TRUE(code == ErrorCode::truncatedInput || code == ErrorCode::malformedInput) << model.error().message;
    }
  }
}

TEST(ReadPly, DoesNotTrustCounts) {
  const std::string vertices = "element vertex 4000000000000\nproperty float x\nproperty float y\nproperty float z\n";
  expectError(header("binary_little_endian", vertices), ErrorCode::truncatedInput, "vertex 0");
  expectError(header("ascii", vertices) + "1 2 3\n", ErrorCode::truncatedInput, "vertex 1");
  const std::string faces = "element nothing 4000000000000\nelement face 1\nproperty list uint int vertex_indices\n";
  expectError(header("binary_little_endian", faces) + "\xff\xff\xff\xff....", ErrorCode::truncatedInput, "face 0");
  expectError(header("ascii", faces) + "4294967295 1 2 3", ErrorCode::truncatedInput, "face 0");
}

/// Vertices (0, 0) (1, 0) (0, 1) (1, 1) (0, 2) (1, 2), and one list of strips.
std::string withStrips(const std::string& list) {
  return "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n" +
         list + "\n";
}

TEST(ReadPly, ReadsTriangleStrips) {
  // Two squares, as one strip, as two, and with the vertices that strips repeat to go on elsewhere: always four
  // triangles that look up and cover two units.
  for (const char* const list : {"6 0 1 2 3 4 5", "9 0 1 2 3 -1 2 3 4 5", "10 0 1 2 3 3 2 2 3 4 5"}) {
    const ReadModel model = readOk(withStrips(list));
    ASSERT_EQ(model.mesh.triangles.size(), 4U) << list;
    for (std::size_t t = 0; t < 4; ++t) EXPECT_DOUBLE_EQ(areaVector(model.mesh, t).z, 0.5) << list;
  }
}

TEST(ReadPly, RefusesStripsThatNameNoVertex) {
  expectError(withStrips("4 0 1 2 6"), ErrorCode::indexOutOfRange, "vertex 6");
  expectError(withStrips("4 0 1 2 -2"), ErrorCode::indexOutOfRange, "triangle strip 0");
  expectError(withStrips("2 0 1"), ErrorCode::emptyInput, "no face");
  expectError(withStrips("9 0 1 2"), ErrorCode::truncatedInput, "ends inside");
}

TEST(ReadPly, NamesTheElementAtFault) {
  std::string text = kAsciiPly;
  text.replace(text.find("1 -7 1.5"), 1, "nan");
  expectError(text, ErrorCode::nonFiniteCoordinate, "vertex 2");
  text = kAsciiPly;
  text.replace(text.find("3 0 1 2 20"), 7, "3 0 1 4");
  expectError(text, ErrorCode::indexOutOfRange, "Face 1 of the PLY file (counted from 0) names vertex 4");
  text.replace(text.find("3 0 1 4"), 7, "3 0 1 -1");
  expectError(text, ErrorCode::indexOutOfRange, "face 1");
  text = kAsciiPly;
  text.replace(text.find("1 -7 1.5"), 1, "one");
  expectError(text, ErrorCode::malformedInput, "Line 21: a value of vertex 2");
}

TEST(ReadPly, RefusesHeadersThatMakeNoSense) {
  expectError("ply\nelement vertex 1\nproperty float x\nend_header\n", ErrorCode::malformedInput, "encoded");
  expectError(header("ascii", "property float x\n"), ErrorCode::malformedInput, "before any element");
  expectError(header("ascii", "element vertex -1\n"), ErrorCode::malformedInput, "negative");
  expectError(header("ascii", "element vertex 1\nproperty quad x\n"), ErrorCode::malformedInput, "\"quad\"");
  expectError(header("morse", ""), ErrorCode::malformedInput, "\"morse\"");
  expectError(header("ascii", "element vertex 1\nproperty float x\n"), ErrorCode::malformedInput, "x, y and z");
  expectError(header("ascii", "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n"),
              ErrorCode::emptyInput, "no face");
}

}  // namespace
}  // namespace qmcf
