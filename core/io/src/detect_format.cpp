#include "detect_format.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "qmcf/base/bits.hpp"
#include "text_cursor.hpp"

namespace qmcf {
namespace {

struct KnownFormat {
  std::string_view magic;
  std::string_view name;
};

/// Formats that people try and that can't be read: naming them says more than "unknown".
constexpr auto kUnreadable = std::to_array<KnownFormat>({{"ISO-10303-21", "a STEP file"},
                                                         {"PK\x03\x04", "a ZIP archive (3MF, for example)"},
                                                         {"glTF", "a glTF file"},
                                                         {"Kaydara FBX", "an FBX file"},
                                                         {"\x1f\x8b", "a gzip archive"},
                                                         {"OFF", "an OFF file"},
                                                         {"COFF", "an OFF file"},
                                                         {"NOFF", "an OFF file"},
                                                         {"$MeshFormat", "a Gmsh file"},
                                                         {"# vtk", "a VTK file"},
                                                         {"DBRep", "a BREP file"},
                                                         {"CASCADE", "a BREP file"},
                                                         {"newmtl", "a material library"},
                                                         {"%PDF", "a PDF document"},
                                                         {"\x89PNG", "a picture"},
                                                         {"\xff\xd8\xff", "a picture"},
                                                         {"<", "an XML or HTML document"},
                                                         {"{", "a JSON document"},
                                                         {"\xff\xfe", "UTF-16 text (save it as UTF-8)"},
                                                         {"\xfe\xff", "UTF-16 text (save it as UTF-8)"}});

constexpr auto kObjKeywords = std::to_array<std::string_view>(
    {"v", "vt", "vn", "vp", "f", "l", "p", "o", "g", "s", "mtllib", "usemtl", "mg", "cstype", "deg", "maplib", "lod"});

constexpr std::size_t kStlHeader = 84;
constexpr std::size_t kStlRecord = 50;

std::uint32_t uint32At(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8U | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

bool looksLikeText(std::string_view bytes) {
  constexpr std::size_t kSample = 4096;
  return bytes.substr(0, kSample).find('\0') == std::string_view::npos;
}

bool hasStlSize(std::string_view bytes) {
  return bytes.size() >= kStlHeader &&
         bytes.size() == kStlHeader + std::uint64_t{kStlRecord} * uint32At(bytes, kStlHeader - 4);
}

/// For binary data whose size does not match: whether the first records are numbers of a size that models have.
bool looksLikeBinaryStl(std::string_view bytes) {
  if (bytes.size() < kStlHeader || uint32At(bytes, kStlHeader - 4) == 0) return false;
  const std::size_t records = std::min<std::size_t>((bytes.size() - kStlHeader) / kStlRecord, 16);
  for (std::size_t record = 0; record < records; ++record) {
    for (std::size_t value = 0; value < 12; ++value) {
      const std::size_t offset = kStlHeader + record * kStlRecord + 4 * value;
      const double magnitude = std::fabs(static_cast<double>(bitCast<float>(uint32At(bytes, offset))));
      if (magnitude != 0.0 && !(magnitude > 1e-35 && magnitude < 1e30)) return false;
    }
  }
  return true;
}

Error unknownFormat(std::string_view bytes) {
  const auto* const known = std::find_if(kUnreadable.begin(), kUnreadable.end(),
                                         [&](const KnownFormat& format) { return bytes.starts_with(format.magic); });
  if (known != kUnreadable.end()) {
    return {ErrorCode::unknownFormat,
            "This is " + std::string(known->name) + ", which can't be read; export the model as OBJ, STL or PLY.",
            {}};
  }
  return {ErrorCode::unknownFormat,
          "The content is neither OBJ nor STL nor PLY; export the model in one of these formats.",
          {}};
}

}  // namespace

Result<InputFormat> detectFormat(std::string_view bytes) {
  if (bytes.empty()) return Error{ErrorCode::emptyInput, "The file is empty; export the model again.", {}};
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return InputFormat::ply;
  if (hasStlSize(bytes)) return InputFormat::stlBinary;
  if (!looksLikeText(bytes)) {
    const bool known = std::any_of(kUnreadable.begin(), kUnreadable.end(),
                                   [&](const KnownFormat& format) { return bytes.starts_with(format.magic); });
    if (!known && looksLikeBinaryStl(bytes)) return InputFormat::stlBinary;
    return unknownFormat(bytes);
  }
  TextCursor cursor(bytes);
  cursor.skipSpace();
  while (cursor.peek() == '#' && !bytes.starts_with("# vtk")) {
    cursor.nextLine(false);
    cursor.skipSpace();
  }
  if (cursor.atEnd()) {
    return Error{ErrorCode::emptyInput, "The file holds no data, only blanks or comments; export the model again.", {}};
  }
  const std::string_view keyword = cursor.token();
  if (equalsIgnoringCase(keyword, "solid") || equalsIgnoringCase(keyword, "facet")) return InputFormat::stlAscii;
  if (std::find(kObjKeywords.begin(), kObjKeywords.end(), keyword) != kObjKeywords.end()) return InputFormat::obj;
  return unknownFormat(bytes.substr(cursor.offset()));
}

}  // namespace qmcf
