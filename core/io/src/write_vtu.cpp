#include <string>

#include "mesh_writers.hpp"
#include "qmcf/io/vtu.hpp"
#include "text_writer.hpp"

namespace qmcf {
namespace {

constexpr std::size_t kValuesPerLine = 12;

/// Names of arrays are ours, but may one day come from a user.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

template <class Values>
void writeValues(TextWriter& out, const Values& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    out << values[i] << (i % kValuesPerLine + 1 == kValuesPerLine ? '\n' : ' ');
  out << "\n</DataArray>\n";
}

void writeArray(TextWriter& out, const VtuArray& array) {
  const bool isReal = std::holds_alternative<std::vector<double>>(array.values);
  out << "<DataArray type=\"" << (isReal ? "Float64" : "Int32") << "\" Name=\"" << escaped(array.name)
      << "\" NumberOfComponents=\"" << array.components << "\" format=\"ascii\">\n";
  std::visit([&](const auto& values) { writeValues(out, values); }, array.values);
}

void writeArrays(TextWriter& out, std::string_view tag, const std::vector<VtuArray>& arrays) {
  out << '<' << tag << ">\n";
  for (const VtuArray& array : arrays) writeArray(out, array);
  out << "</" << tag << ">\n";
}

/// VTK's ASCII strings are the codes of their bytes, each string ended by 0.
void writeNames(TextWriter& out, const VtuNames& names) {
  out << "<DataArray type=\"String\" Name=\"" << escaped(names.name) << "\" NumberOfTuples=\"" << names.values.size()
      << "\" format=\"ascii\">\n";
  for (const std::string& value : names.values) {
    for (const char c : value) out << static_cast<int>(static_cast<unsigned char>(c)) << ' ';
    out << "0\n";
  }
  out << "</DataArray>\n";
}

void writeCells(TextWriter& out, const VtuGrid& grid) {
  out << "<Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n";
  writeValues(out, grid.connectivity);
  std::vector<std::int64_t> offsets;
  offsets.reserve(grid.cells.size());
  std::int64_t end = 0;
  for (const VtuCell cell : grid.cells) {
    end += static_cast<std::int64_t>(vtuCellSize(cell));
    offsets.push_back(end);
  }
  out << "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  writeValues(out, offsets);
  out << "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  std::vector<int> types;
  types.reserve(grid.cells.size());
  for (const VtuCell cell : grid.cells) types.push_back(static_cast<int>(cell));
  writeValues(out, types);
  out << "</Cells>\n";
}

}  // namespace

std::size_t vtuCellSize(VtuCell cell) {
  switch (cell) {
    case VtuCell::vertex:
      return 1;
    case VtuCell::line:
      return 2;
    case VtuCell::triangle:
      return 3;
    case VtuCell::quad:
      break;
  }
  return 4;
}

std::string writeVtu(const VtuGrid& grid) {
  TextWriter out;
  out.reserve(grid.points.size() * 60 + grid.connectivity.size() * 10);
  out << "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
         "<UnstructuredGrid>\n";
  if (!grid.names.empty()) {
    out << "<FieldData>\n";
    for (const VtuNames& names : grid.names) writeNames(out, names);
    out << "</FieldData>\n";
  }
  out << "<Piece NumberOfPoints=\"" << grid.points.size() << "\" NumberOfCells=\"" << grid.cells.size() << "\">\n"
      << "<Points>\n<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const Vec3& point : grid.points) out << point << '\n';
  out << "</DataArray>\n</Points>\n";
  writeCells(out, grid);
  writeArrays(out, "PointData", grid.pointData);
  writeArrays(out, "CellData", grid.cellData);
  out << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  return out.take();
}

std::string writeVtuMesh(const QuadMesh& mesh, const WriteOptions& options) {
  const GroupNames names = groupNames(mesh, options, NameRule::quotedText);
  VtuGrid grid;
  grid.points = mesh.positions;
  std::vector<std::int32_t> face;
  std::vector<std::int32_t> edge;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const std::size_t corners = cornerCount(mesh.elements[e]);
    for (std::size_t c = 0; c < corners; ++c) grid.connectivity.push_back(mesh.elements[e][c]);
    grid.cells.push_back(corners == 3 ? VtuCell::triangle : VtuCell::quad);
    face.push_back(faceOf(mesh, e));
    edge.push_back(kNone);
  }
  for (const FeatureSegment& segment : mesh.featureSegments) {
    if (segment.edge < 0) continue;
    grid.connectivity.push_back(segment.a);
    grid.connectivity.push_back(segment.b);
    grid.cells.push_back(VtuCell::line);
    face.push_back(kNone);
    edge.push_back(segment.edge);
  }
  grid.cellData = {{"face", 1, std::move(face)}, {"edge", 1, std::move(edge)}};
  grid.names = {{"faceNames", names.faces}, {"edgeNames", names.edges}};
  return writeVtu(grid);
}

}  // namespace qmcf
