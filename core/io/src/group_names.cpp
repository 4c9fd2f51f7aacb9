#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "mesh_writers.hpp"
#include "text_cursor.hpp"

namespace qmcf {
namespace {

constexpr std::size_t kLongestName = 64;

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

bool isAllowed(char c, NameRule rule) {
  switch (rule) {
    case NameRule::word:
      return static_cast<unsigned char>(c) > 0x20U && c != '"' && c != '\\' && c != '#';
    case NameRule::quotedText:
      return c != '"' && c != '\\';
    case NameRule::identifier:
      break;
  }
  return isLetter(c) || isDigit(c) || c == '_';
}

std::string sanitized(std::string_view name, NameRule rule) {
  std::string result = cleanName(name, kLongestName);
  std::replace_if(
      result.begin(), result.end(), [&](char c) { return !isAllowed(c, rule); }, '_');
  if (rule == NameRule::identifier && !result.empty() && !isLetter(result.front())) result.insert(0, "n_");
  return result;
}

std::string caseFolded(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return name;
}

std::vector<std::string> uniqueNames(const std::vector<std::string>& wanted, std::size_t count,
                                     const std::string& prefix, NameRule rule, std::set<std::string>& used) {
  std::vector<std::string> names;
  names.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);  // The id that reports use.
    std::string name = i < wanted.size() ? sanitized(wanted[i], rule) : std::string();
    if (name.empty()) name = prefix + number;
    // The own number makes a repeated name different from all others but one that was made to look like it.
    while (!used.insert(caseFolded(name)).second) name += '_' + number;
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

std::int32_t faceOf(const QuadMesh& mesh, std::size_t element) {
  return element < mesh.elementFace.size() ? std::max(mesh.elementFace[element], 0) : 0;
}

std::size_t faceCount(const QuadMesh& mesh) {
  std::int32_t last = kNone;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) last = std::max(last, faceOf(mesh, e));
  return last == kNone ? 0 : static_cast<std::size_t>(last) + 1;
}

std::size_t edgeCount(const QuadMesh& mesh) {
  std::int32_t last = kNone;
  for (const FeatureSegment& segment : mesh.featureSegments) last = std::max(last, segment.edge);
  return last == kNone ? 0 : static_cast<std::size_t>(last) + 1;
}

std::vector<std::vector<FeatureSegment>> segmentsByEdge(const QuadMesh& mesh) {
  std::vector<std::vector<FeatureSegment>> edges(edgeCount(mesh));
  for (const FeatureSegment& segment : mesh.featureSegments) {
    if (segment.edge >= 0) edges[static_cast<std::size_t>(segment.edge)].push_back(segment);
  }
  return edges;
}

GroupNames groupNames(const QuadMesh& mesh, const WriteOptions& options, NameRule rule) {
  std::set<std::string> used;
  GroupNames names;
  names.faces = uniqueNames(options.faceNames, faceCount(mesh), "face_", rule, used);
  names.edges = uniqueNames(options.edgeNames, edgeCount(mesh), "edge_", rule, used);
  return names;
}

}  // namespace qmcf
