#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "qmcf/pipeline/report_json.hpp"

namespace qmcf {
namespace {

using Json = nlohmann::ordered_json;

void append(std::string& text, std::int32_t number) { text += std::to_string(number); }

template <class Row>
void append(std::string& text, const std::vector<Row>& rows);

template <std::size_t N>
void append(std::string& text, const std::array<std::int32_t, N>& row) {
  for (std::size_t i = 0; i < N; ++i) {
    if (i > 0) text += ',';
    append(text, row[i]);
  }
}

/// The rows one after the other, without brackets of their own.
template <class Row>
void append(std::string& text, const std::vector<Row>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0) text += ',';
    append(text, rows[i]);
  }
}

template <class Rows>
void appendList(std::string& text, const char* name, const Rows& rows) {
  if (rows.empty()) return;
  text += ",\"";
  text += name;
  text += "\":[";
  append(text, rows);
  text += ']';
}

void appendNumber(std::string& text, const char* name, std::int32_t number) {
  if (number == 0) return;
  text += ",\"";
  text += name;
  text += "\":";
  append(text, number);
}

void appendStep(std::string& text, const TraceStep& step) {
  text += "{\"kind\":\"";
  text += traceKindName(step.kind);
  text += '"';
  if (step.isReset) {
    text += ",\"boundary\":[";
    for (std::size_t i = 0; i < step.boundary.size(); ++i) {
      text += i > 0 ? ",[" : "[";
      append(text, step.boundary[i]);
      text += ']';
    }
    text += ']';
  }
  if (step.base[0] != kNone) appendList(text, "base", std::vector{step.base});
  appendNumber(text, "pass", step.pass);
  appendNumber(text, "undone", step.undone);
  appendList(text, "failed", step.failed);
  appendList(text, "vertices", step.vertices);
  appendList(text, "elements", step.elements);
  appendList(text, "removed", step.removed);
  appendList(text, "states", step.states);
  text += '}';
}

}  // namespace

std::string traceJson(const MeshResult& result) {
  const MeshTrace& trace = *result.trace;
  const Vec3& origin = trace.scale.origin;
  std::string text = R"({"format":"qmcf-trace","version":1,"origin":)" + Json{origin.x, origin.y, origin.z}.dump() +
                     ",\"unit\":" + Json(trace.scale.unit).dump() + ",\"faces\":[";
  for (std::size_t f = 0; f < trace.faces.size(); ++f) {
    const FaceReport& report = result.faces[f];
    text += f > 0 ? ",\n{" : "\n{";
    text += "\"face\":" + std::to_string(report.face) + ",\"method\":" + Json(report.method).dump() +
            ",\"reason\":" + Json(report.reason).dump() + ",\"steps\":[";
    const std::vector<TraceStep>& steps = trace.faces[f].steps;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      text += i > 0 ? ",\n" : "\n";
      appendStep(text, steps[i]);
    }
    text += "]}";
  }
  return text + "\n]}\n";
}

}  // namespace qmcf
