#include "qmcf/io/write.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "io_support.hpp"
#include "qmcf/io/vtu.hpp"

namespace qmcf {
namespace {

/// Two squares and a triangle on two faces, with the seam and one side as edges. Coordinates that need all digits.
QuadMesh example() {
  QuadMesh mesh;
  mesh.positions = {{0.0, 0.0, 0.0},   {1.0 / 3.0, 0.0, 0.0}, {0.1 + 0.2, 1.0, 1e-17},
                    {0.0, 1.0, -1e25}, {2.0, 0.0, 0.0},       {2.0, 1.0, -0.00012345678901234567}};
  mesh.elements = {{0, 1, 2, 3}, {1, 4, 5, 2}, {4, 5, 3, kNone}};
  mesh.elementFace = {0, 1, 1};
  mesh.featureSegments = {{1, 2, 1}, {0, 1, 0}, {1, 4, 0}};
  return mesh;
}

const WriteOptions kNames{{"top side", "top side"}, {"rim \"A\"", ""}};

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::size_t countLines(const std::string& text, std::string_view start) {
  const std::vector<std::string> lines = linesOf(text);
  return static_cast<std::size_t>(
      std::count_if(lines.begin(), lines.end(), [&](const std::string& line) { return line.starts_with(start); }));
}

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST(OutputFormatOf, FollowsTheExtension) {
  EXPECT_EQ(outputFormatOf("a.b/part.OBJ"), OutputFormat::obj);
  EXPECT_EQ(outputFormatOf("x.vtu"), OutputFormat::vtu);
  EXPECT_EQ(outputFormatOf("x.nas"), OutputFormat::bdf);
  EXPECT_EQ(outputFormatOf("x.step"), std::nullopt);
  EXPECT_EQ(outputFormatOf("obj"), std::nullopt);
  EXPECT_EQ(outputFormatOf(""), std::nullopt);
}

TEST(Write, ObjAndPlyReadBackAsTheSameMesh) {
  const QuadMesh mesh = example();
  for (const OutputFormat format : {OutputFormat::obj, OutputFormat::ply}) {
    const std::string content = writeMesh(mesh, format, kNames);
    const Result<QuadMesh> back = readQuads(content);
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back.value().positions, mesh.positions);
    EXPECT_EQ(back.value().elements, mesh.elements);
    EXPECT_EQ(back.value().elementFace, mesh.elementFace);
    std::map<std::int32_t, std::size_t> segments;
    for (const FeatureSegment& segment : back.value().featureSegments) ++segments[segment.edge];
    EXPECT_EQ(segments.size(), 2U);
    EXPECT_EQ(back.value().featureSegments.size(), 3U);
    EXPECT_EQ(readOk(content).mesh.labelNames.size(), 2U);
  }
}

TEST(Write, GroupNamesAreValidAndDifferent) {
  const std::string obj = writeMesh(example(), OutputFormat::obj, kNames);
  EXPECT_EQ(countLines(obj, "g "), 4U);
  EXPECT_TRUE(contains(obj, "g top_side\nf 1 2 3 4\ng top_side_1\nf 2 5 6 3\n")) << obj;
  EXPECT_TRUE(contains(obj, "g rim__A_\nl 1 2\nl 2 5\ng edge_1\nl 2 3\n")) << obj;
  EXPECT_TRUE(contains(writeMesh(example(), OutputFormat::obj), "g face_0\n"));
  // Names in solver input ignore case, and must begin with a letter.
  const std::string inp = writeMesh(example(), OutputFormat::inp, {{"Skin", "skin"}, {"1\xc3\xa4", ""}});
  EXPECT_TRUE(contains(inp, "ELSET=Skin\n"));
  EXPECT_TRUE(contains(inp, "ELSET=skin_1\n"));
  EXPECT_TRUE(contains(inp, "NSET=n_1__\n")) << inp;
}

TEST(Write, StlHoldsTwoTrianglesPerQuadrilateral) {
  const QuadMesh mesh = example();
  const ReadModel model = readOk(writeMesh(mesh, OutputFormat::stl));
  EXPECT_EQ(model.format, InputFormat::stlBinary);
  EXPECT_EQ(model.mesh.triangles.size(), 5U);
  EXPECT_EQ(model.mesh.positions[1].x, static_cast<double>(1.0F / 3.0F));
}

TEST(Write, InpHasEveryNodeElementAndSet) {
  const std::string inp = writeMesh(example(), OutputFormat::inp, kNames);
  EXPECT_TRUE(contains(inp, "*ELEMENT, TYPE=S4, ELSET=top_side\n1, 1, 2, 3, 4\n")) << inp;
  EXPECT_TRUE(contains(inp, "*ELEMENT, TYPE=S4, ELSET=top_side_1\n2, 2, 5, 6, 3\n"));
  EXPECT_TRUE(contains(inp, "*ELEMENT, TYPE=S3, ELSET=top_side_1\n3, 5, 6, 4\n"));
  EXPECT_TRUE(contains(inp, "*NSET, NSET=edge_1\n2, 3\n"));
  // Abaqus and CalculiX read 20 characters of a number.
  EXPECT_TRUE(contains(inp, "\n2, 0.3333333333333333, 0., 0.\n"));
  EXPECT_TRUE(contains(inp, "\n6, 2., 1., -1.23456789012346E-4\n")) << inp;
  EXPECT_TRUE(contains(inp, ", -1.E+25\n"));
}

TEST(Write, SolverNumbersKeepTheDigitsThatFit) {
  QuadMesh mesh = example();
  for (const double value :
       {1.0 / 3.0, -2.0 / 3.0, 123456.78901234567, -9.9999999999999999e-5, 0.99999999999999989, 1e22,
        -1.7976931348623157e-300, 4.9406564584124654e-324, 1234567890123456.7, 1e-9, 0.0, 7.0}) {
    mesh.positions[0] = {value, 0.0, 0.0};
    const std::string inp = writeMesh(mesh, OutputFormat::inp);
    const std::string number =
        inp.substr(inp.find("\n1, ") + 4, inp.find(", ", inp.find("\n1, ") + 4) - inp.find("\n1, ") - 4);
    EXPECT_LE(number.size(), 20U) << number;
    EXPECT_TRUE(contains(number, ".")) << number;
    EXPECT_NEAR(std::strtod(number.c_str(), nullptr), value, std::fabs(value) * 1e-12) << number;

    std::string field = writeMesh(mesh, OutputFormat::bdf);
    field = field.substr(field.find("GRID*") + 40, 16);
    const std::size_t sign = field.find_last_of("+-");
    const bool hasExponent = sign != std::string::npos && sign > 0 && field[sign - 1] != ' ';
    if (hasExponent) field.insert(sign, "e");
    EXPECT_NEAR(std::strtod(field.c_str(), nullptr), value, std::fabs(value) * 1e-9) << field;
  }
}

TEST(Write, InpSetsHaveAtMostSixteenNodesPerLine) {
  QuadMesh mesh = example();
  mesh.positions.resize(50);
  for (std::int32_t i = 0; i < 40; ++i) mesh.featureSegments.push_back({i, i + 1, 0});
  const std::string inp = writeMesh(mesh, OutputFormat::inp);
  for (const std::string& line : linesOf(inp)) EXPECT_LE(std::count(line.begin(), line.end(), ','), 15) << line;
}

TEST(Write, BdfFieldsHaveTheirWidths) {
  QuadMesh mesh = example();
  for (std::int32_t i = 0; i < 40; ++i) mesh.featureSegments.push_back({i % 6, (i + 1) % 6, i % 2});
  const std::string bdf = writeMesh(mesh, OutputFormat::bdf, kNames);
  EXPECT_EQ(countLines(bdf, "GRID*   "), 6U);
  EXPECT_EQ(countLines(bdf, "CQUAD4  "), 2U);
  EXPECT_TRUE(contains(bdf, "CTRIA3         3       2       5       6       4\n")) << bdf;
  EXPECT_EQ(countLines(bdf, "SET "), 2U);
  EXPECT_TRUE(contains(bdf,
                       "GRID*                  6                              2.              1.*\n"
                       "*       -1.23456789012-4\n"))
      << bdf;
  for (const std::string& line : linesOf(bdf)) EXPECT_LE(line.size(), 73U);
}

/// The numbers of one section of an MSH file, and its lines.
std::vector<std::string> section(const std::string& msh, const std::string& name) {
  const std::vector<std::string> lines = linesOf(msh);
  const auto begin = std::find(lines.begin(), lines.end(), "$" + name);
  const auto end = std::find(begin, lines.end(), "$End" + name);
  return begin == end ? std::vector<std::string>{} : std::vector<std::string>(begin + 1, end);
}

TEST(Write, MshCountsAgreeWithItsBlocks) {
  const std::string msh = writeMesh(example(), OutputFormat::msh, kNames);
  EXPECT_EQ(section(msh, "PhysicalNames"), (std::vector<std::string>{"4", "1 1 \"rim _A_\"", "1 2 \"edge_1\"",
                                                                     "2 1 \"top side\"", "2 2 \"top side_1\""}));
  // Points: the ends of both edges, of which one meets the other in its middle.
  const std::vector<std::string> entities = section(msh, "Entities");
  ASSERT_EQ(entities.size(), 9U);
  EXPECT_EQ(entities[0], "4 2 2 0");

  for (const std::string name : {"Nodes", "Elements"}) {
    std::istringstream in(msh.substr(msh.find("$" + name) + name.size() + 1));
    std::size_t blocks = 0;
    std::size_t total = 0;
    std::size_t skip = 0;
    in >> blocks >> total >> skip >> skip;
    EXPECT_EQ(total, name == "Nodes" ? 6U : 6U);
    std::set<int> tags;
    for (std::size_t b = 0; b < blocks; ++b) {
      int dimension = 0;
      int entity = 0;
      int type = 0;
      std::size_t count = 0;
      in >> dimension >> entity >> type >> count;
      const int perElement = type == 1 ? 2 : type == 2 ? 3 : 4;
      for (std::size_t i = 0; i < count; ++i) {
        int tag = 0;
        in >> tag;
        EXPECT_TRUE(tags.insert(tag).second);
        for (int c = 0; name == "Elements" && c < perElement; ++c) in >> skip;
      }
      double coordinate = 0.0;
      for (std::size_t i = 0; name == "Nodes" && i < 3 * count; ++i) in >> coordinate;
    }
    EXPECT_EQ(tags.size(), total);
    EXPECT_TRUE(in.good());
  }
}

TEST(Write, VtuHoldsCellsFacesAndEdges) {
  const std::string vtu = writeMesh(example(), OutputFormat::vtu, kNames);
  EXPECT_TRUE(contains(vtu, "<Piece NumberOfPoints=\"6\" NumberOfCells=\"6\">"));
  EXPECT_TRUE(contains(vtu, "Name=\"connectivity\" format=\"ascii\">\n0 1 2 3 1 4 5 2 4 5 3 1\n2 0 1 1 4 \n"));
  EXPECT_TRUE(contains(vtu, "Name=\"offsets\" format=\"ascii\">\n4 8 11 13 15 17 \n"));
  EXPECT_TRUE(contains(vtu, "Name=\"types\" format=\"ascii\">\n9 9 5 3 3 3 \n"));
  EXPECT_TRUE(contains(vtu, "Name=\"face\" NumberOfComponents=\"1\" format=\"ascii\">\n0 1 1 -1 -1 -1 \n"));
  EXPECT_TRUE(contains(vtu, "\n0.3333333333333333 0 0\n"));
  EXPECT_TRUE(contains(vtu, "Name=\"faceNames\" NumberOfTuples=\"2\""));
}

TEST(Write, NothingIsLostWithoutFacesAndEdges) {
  QuadMesh mesh = example();
  mesh.elementFace.clear();
  mesh.featureSegments.clear();
  for (const OutputFormat format : {OutputFormat::obj, OutputFormat::ply, OutputFormat::stl}) {
    EXPECT_EQ(readOk(writeMesh(mesh, format)).mesh.triangles.size(), 5U);
  }
  EXPECT_EQ(section(writeMesh(mesh, OutputFormat::msh), "Nodes")[0], "1 6 1 6");
  EXPECT_FALSE(contains(writeMesh(mesh, OutputFormat::inp), "*NSET"));
}

TEST(WriteVtu, WritesAnyArrays) {
  VtuGrid grid;
  grid.points = {{0.5, 0, 0}, {1, 0, 0}};
  grid.connectivity = {0, 1, 1};
  grid.cells = {VtuCell::line, VtuCell::vertex};
  grid.pointData = {{"a < b & \"c\"", 3, std::vector<double>{1, 0, 0, 0, 0.1, 0}}};
  grid.cellData = {{"index", 1, std::vector<std::int32_t>{-1, 7}}};
  const std::string vtu = writeVtu(grid);
  EXPECT_TRUE(contains(vtu,
                       "type=\"Float64\" Name=\"a &lt; b &amp; &quot;c&quot;\" NumberOfComponents=\"3\" "
                       "format=\"ascii\">\n1 0 0 0 0.1 0 \n"));
  EXPECT_TRUE(contains(vtu, "type=\"Int32\" Name=\"index\" NumberOfComponents=\"1\" format=\"ascii\">\n-1 7 \n"));
  EXPECT_TRUE(contains(vtu, "Name=\"offsets\" format=\"ascii\">\n2 3 \n"));
}

}  // namespace
}  // namespace qmcf
