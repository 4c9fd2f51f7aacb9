#include "sizing_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "files.hpp"

namespace qmcf::cli {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

Error wrongLine(std::size_t line, const std::string& what) {
  return {ErrorCode::malformedInput,
          "Line " + std::to_string(line) + ": " + what +
              ". Each line must hold one edge length above 0, for one vertex of the model.",
          {static_cast<std::int64_t>(line)}};
}

/// A line for a message, not longer than fits there.
std::string quoted(std::string_view text) {
  constexpr std::size_t kMost = 40;
  return "\"" + std::string(text.substr(0, kMost)) + (text.size() > kMost ? "..." : "") + "\"";
}

}  // namespace

std::string sizingText(const std::vector<double>& size) {
  std::string text;
  for (const double h : size) {
    constexpr std::size_t kMostDigits = 32;
    char digits[kMostDigits];
    const auto [end, error] = std::to_chars(digits, digits + kMostDigits, h);
    (void)error;  // 32 characters hold the shortest form of every double.
    text.append(digits, end).push_back('\n');
  }
  return text;
}

std::string sizingText(const ReadModel& model, const std::vector<double>& size) {
  const std::vector<std::int32_t> vertices = fileVertices(model);
  std::vector<double> ofFile;
  for (std::size_t v = 0; v < size.size(); ++v) {
    if (vertices[v] >= static_cast<std::int32_t>(ofFile.size())) ofFile.push_back(size[v]);
  }
  return sizingText(ofFile);
}

Result<std::vector<double>> readSizing(const std::string& path) {
  const Result<std::vector<std::byte>> bytes = readFile(path);
  if (!bytes.ok()) return bytes.error();
  std::string_view rest(reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size());
  rest = rest.substr(0, rest.find_last_not_of(" \t\r\n") + 1);
  if (rest.empty())
    return Error{
        ErrorCode::malformedInput, "The file is empty. It must hold one edge length for each vertex of the model.", {}};
  std::vector<double> sizes;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view text = trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const std::size_t line = sizes.size() + 1;
    if (text.empty()) return wrongLine(line, "there is no number");
    double size = 0.0;
    const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), size);
    if (error == std::errc::invalid_argument || last != text.data() + text.size()) {
      return wrongLine(line, quoted(text) + " is not a number");
    }
    if (error != std::errc() || !std::isfinite(size)) {
      return wrongLine(line, quoted(text) + " is no finite number");
    }
    if (!(size > 0.0)) return wrongLine(line, quoted(text) + " is not above 0");
    sizes.push_back(size);
  }
  return sizes;
}

Result<std::vector<double>> spreadSizing(const std::vector<double>& sizes, const ReadModel& model) {
  const std::vector<std::int32_t> vertices = fileVertices(model);
  const auto most = std::max_element(vertices.begin(), vertices.end());
  const std::size_t count = most == vertices.end() ? 0 : static_cast<std::size_t>(*most) + 1;
  if (sizes.size() != count) {
    return Error{ErrorCode::malformedInput,
                 "The file has " + std::to_string(sizes.size()) + " lines, but the model has " + std::to_string(count) +
                     " vertices. Give one length per vertex, in the model's order, as --sizing-out writes them.",
                 {}};
  }
  std::vector<double> spread;
  spread.reserve(vertices.size());
  for (const std::int32_t v : vertices) spread.push_back(sizes[static_cast<std::size_t>(v)]);
  return spread;
}

}  // namespace qmcf::cli
