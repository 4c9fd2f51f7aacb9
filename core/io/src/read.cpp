#include "qmcf/io/read.hpp"

#include <array>
#include <string>
#include <utility>

#include "detect_format.hpp"
#include "polygon_soup.hpp"
#include "polygon_triangulator.hpp"

namespace qmcf {
namespace {

struct Content {
  PolygonSoup soup;
  InputFormat format = InputFormat::obj;
};

Result<PolygonSoup> readSoup(std::string_view bytes, InputFormat format, Progress& progress) {
  switch (format) {
    case InputFormat::obj:
      return readObj(bytes, progress);
    case InputFormat::stlAscii:
      return readStlAscii(bytes, progress);
    case InputFormat::stlBinary:
      return readStlBinary(bytes, progress);
    case InputFormat::ply:
      return readPly(bytes, progress);
  }
  return Error{};
}

Result<Content> readContent(std::span<const std::byte> input, Progress& progress) {
  // Bytes are looked at as characters, which C++ allows.
  std::string_view bytes(reinterpret_cast<const char*>(input.data()), input.size());
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  const Result<InputFormat> format = detectFormat(bytes);
  if (!format.ok()) return format.error();
  Result<PolygonSoup> soup = readSoup(bytes, format.value(), progress);
  if (!soup.ok()) return soup.error();
  if (soup.value().faceEnd.empty()) {
    const std::size_t vertices = soup.value().positions.size();
    return Error{ErrorCode::emptyInput,
                 "The file has " + std::to_string(vertices) + " vertices but no face; export the model as a mesh.",
                 {}};
  }
  return Content{std::move(soup).value(), format.value()};
}

}  // namespace

std::string_view inputFormatName(InputFormat format) {
  constexpr auto kNames = std::to_array<std::string_view>({"OBJ", "ASCII STL", "binary STL", "PLY"});
  return kNames[static_cast<std::size_t>(format)];
}

Result<ReadModel> readModel(std::span<const std::byte> bytes, Progress& progress) {
  Result<Content> content = readContent(bytes, progress);
  if (!content.ok()) return content.error();
  PolygonSoup soup = std::move(content).value().soup;
  const std::size_t faces = soup.faceCount();
  const std::size_t triangles = soup.corners.size() - 2 * faces;
  if (triangles > kMaxIndex / 3) return tooLargeError("half-edges");

  ReadModel model;
  model.format = content.value().format;
  model.polygons = static_cast<std::int64_t>(faces);
  model.skippedFaces = soup.skippedFaces;
  model.mesh.positions = std::move(soup.positions);
  model.mesh.labelNames = std::move(soup.labelNames);
  model.mesh.triangles.reserve(triangles);
  if (!soup.labels.empty()) model.mesh.labels.reserve(triangles);
  PolygonTriangulator triangulator(model.mesh.positions);
  constexpr std::size_t kFacesPerReport = 4096;
  for (std::size_t f = 0; f < faces; ++f) {
    if (f % kFacesPerReport == 0 && !progress.report(Stage::read, 1.0)) return cancelledError();
    triangulator.triangulate(soup.face(f), model.mesh.triangles);
    if (!soup.labels.empty()) model.mesh.labels.resize(model.mesh.triangles.size(), soup.labels[f]);
  }
  return model;
}

Result<QuadMesh> readQuadMesh(std::span<const std::byte> bytes, Progress& progress) {
  Result<Content> content = readContent(bytes, progress);
  if (!content.ok()) return content.error();
  const InputFormat format = content.value().format;
  if (format != InputFormat::obj && format != InputFormat::ply) {
    return Error{ErrorCode::unknownFormat,
                 "A quad mesh is read from OBJ or PLY, but this file is " + std::string(inputFormatName(format)) + ".",
                 {}};
  }
  PolygonSoup soup = std::move(content).value().soup;
  QuadMesh mesh;
  mesh.elements.reserve(soup.faceCount());
  for (std::size_t f = 0; f < soup.faceCount(); ++f) {
    const std::span<const std::int32_t> face = soup.face(f);
    if (face.size() > 4) {
      return Error{ErrorCode::malformedInput,
                   "Face " + std::to_string(f) + " (counted from 0) has " + std::to_string(face.size()) +
                       " corners, but only triangles and quadrilaterals can be checked.",
                   {static_cast<std::int64_t>(f)}};
    }
    mesh.elements.push_back({face[0], face[1], face[2], face.size() == 4 ? face[3] : kNone});
  }
  mesh.positions = std::move(soup.positions);
  mesh.elementFace = std::move(soup.labels);
  mesh.elementFace.resize(mesh.elements.size(), 0);
  mesh.featureSegments.reserve(soup.segments.size());
  for (const auto& [a, b, chain] : soup.segments) mesh.featureSegments.push_back({a, b, chain});
  return mesh;
}

}  // namespace qmcf
