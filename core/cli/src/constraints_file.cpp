#include "constraints_file.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "files.hpp"

namespace qmcf::cli {
namespace {

using Json = nlohmann::json;

std::optional<Vec3> pointOf(const Json& stroke, const char* name) {
  if (!stroke.is_object() || !stroke.contains(name)) return std::nullopt;
  const Json& point = stroke[name];
  const auto isNumber = [](const Json& x) { return x.is_number(); };
  if (!point.is_array() || point.size() != 3 || !std::all_of(point.begin(), point.end(), isNumber)) return std::nullopt;
  return Vec3{point[0].get<double>(), point[1].get<double>(), point[2].get<double>()};
}

}  // namespace

Result<std::vector<FieldStroke>> readConstraints(const std::string& path) {
  const Result<std::vector<std::byte>> bytes = readFile(path);
  if (!bytes.ok()) return bytes.error();
  const auto* text = reinterpret_cast<const char*>(bytes.value().data());
  const Json file = Json::parse(text, text + bytes.value().size(), nullptr, false);
  if (!file.is_object() || file.size() != 1 || !file.contains("strokes") || !file["strokes"].is_array()) {
    return Error{ErrorCode::invalidOption,
                 R"(the file must hold {"strokes": [{"from": [x, y, z], "to": [x, y, z]}, ...]}.)",
                 {}};
  }
  std::vector<FieldStroke> strokes;
  for (const Json& stroke : file["strokes"]) {
    const std::optional<Vec3> from = pointOf(stroke, "from");
    const std::optional<Vec3> to = pointOf(stroke, "to");
    if (!from || !to) {
      return Error{ErrorCode::invalidOption,
                   "strokes[" + std::to_string(strokes.size()) + R"(] must be {"from": [x, y, z], "to": [x, y, z]}.)",
                   {static_cast<std::int64_t>(strokes.size())}};
    }
    strokes.push_back({*from, *to});
  }
  return strokes;
}

}  // namespace qmcf::cli
