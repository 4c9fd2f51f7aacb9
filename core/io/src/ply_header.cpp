#include "ply_header.hpp"

#include <array>
#include <optional>
#include <utility>

#include "polygon_soup.hpp"
#include "text_cursor.hpp"

namespace qmcf {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr auto kTypeNames = std::to_array<TypeName>({{"char", PlyType::int8},
                                                     {"uchar", PlyType::uint8},
                                                     {"short", PlyType::int16},
                                                     {"ushort", PlyType::uint16},
                                                     {"int", PlyType::int32},
                                                     {"uint", PlyType::uint32},
                                                     {"float", PlyType::float32},
                                                     {"double", PlyType::float64},
                                                     {"int8", PlyType::int8},
                                                     {"uint8", PlyType::uint8},
                                                     {"int16", PlyType::int16},
                                                     {"uint16", PlyType::uint16},
                                                     {"int32", PlyType::int32},
                                                     {"uint32", PlyType::uint32},
                                                     {"float32", PlyType::float32},
                                                     {"float64", PlyType::float64}});

std::optional<PlyType> typeNamed(std::string_view name) {
  for (const TypeName& row : kTypeNames) {
    if (row.name == name) return row.type;
  }
  return std::nullopt;
}

bool isInteger(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view bytes) : bytes_(bytes), cursor_(bytes) {}

  Result<PlyHeader> read();

 private:
  std::string_view nextToken() {
    cursor_.skipBlanks();
    const std::string_view token = cursor_.token();
    cursor_.advance(token.size());
    return token;
  }
  bool readStatement(std::string_view keyword);
  bool readEncoding();
  bool readElement();
  bool readProperty();
  bool readType(PlyType& type);
  void finish();
  bool fail(const std::string& sentence) {
    error_ = lineError(ErrorCode::malformedInput, cursor_.line(), sentence);
    return false;
  }

  std::string_view bytes_;
  TextCursor cursor_;
  PlyHeader header_;
  bool encodingKnown_ = false;
  Error error_;
};

bool HeaderReader::readType(PlyType& type) {
  const std::string_view name = nextToken();
  const std::optional<PlyType> found = typeNamed(name);
  if (!found) return fail(quoted(name) + " is not a type of the PLY format; export the model again.");
  type = *found;
  return true;
}

bool HeaderReader::readEncoding() {
  const std::string_view name = nextToken();
  encodingKnown_ = true;
  if (name == "ascii") {
    header_.encoding = PlyEncoding::ascii;
  } else if (name == "binary_little_endian") {
    header_.encoding = PlyEncoding::littleEndian;
  } else if (name == "binary_big_endian") {
    header_.encoding = PlyEncoding::bigEndian;
  } else {
    return fail("the PLY encoding " + quoted(name) + " is not known; export the model again.");
  }
  return true;
}

bool HeaderReader::readElement() {
  PlyElement element;
  element.name = nextToken();
  std::int64_t count = 0;
  if (cursor_.integer(count) != NumberState::ok || count < 0) {
    return fail("the number of " + quoted(element.name) + " elements is missing or negative; export the model again.");
  }
  element.count = static_cast<std::uint64_t>(count);
  header_.elements.push_back(std::move(element));
  return true;
}

bool HeaderReader::readProperty() {
  if (header_.elements.empty()) return fail("a property comes before any element; export the model again.");
  PlyProperty property;
  cursor_.skipBlanks();
  if (cursor_.token() == "list") {
    nextToken();
    property.isList = true;
    if (!readType(property.countType)) return false;
    if (!isInteger(property.countType)) return fail("the length of a list can't be a decimal number; export again.");
  }
  if (!readType(property.type)) return false;
  property.name = nextToken();
  header_.elements.back().properties.push_back(property);
  return true;
}

bool HeaderReader::readStatement(std::string_view keyword) {
  if (keyword == "format") return readEncoding();
  if (keyword == "element") return readElement();
  if (keyword == "property") return readProperty();
  if (keyword == "comment") {
    header_.comments.push_back(cursor_.restOfLine());
    return true;
  }
  if (keyword.empty() || keyword == "obj_info") return true;
  return fail("the PLY header has an unknown statement " + quoted(keyword) + "; export the model again.");
}

/// Binary data begins right behind the header's last line end, whose style is that of the first line: after a lone CR
/// the first byte of data may well be an LF.
void HeaderReader::finish() {
  const bool loneCr = bytes_[3] == '\r' && bytes_[4] != '\n';
  while (!cursor_.atLineEnd()) cursor_.advance(1);
  header_.size = cursor_.offset();
  if (header_.size < bytes_.size())
    header_.size += bytes_[header_.size] == '\r' && !loneCr ? std::size_t{2} : std::size_t{1};
  header_.size = header_.size < bytes_.size() ? header_.size : bytes_.size();
  header_.lines = cursor_.line();
}

Result<PlyHeader> HeaderReader::read() {
  cursor_.nextLine(false);
  while (!cursor_.atEnd()) {
    const std::string_view keyword = nextToken();
    if (keyword == "end_header") {
      if (!encodingKnown_) fail("the PLY header does not say how the data is encoded; export the model again.");
      if (!encodingKnown_) return std::move(error_);
      finish();
      return std::move(header_);
    }
    if (!readStatement(keyword)) return std::move(error_);
    cursor_.nextLine(false);
  }
  return Error{ErrorCode::truncatedInput, "The PLY file ends inside its header; copy or export it again.", {}};
}

}  // namespace

std::size_t plyTypeSize(PlyType type) {
  constexpr auto kSizes = std::to_array<std::size_t>({1, 1, 2, 2, 4, 4, 4, 8});
  return kSizes[static_cast<std::size_t>(type)];
}

Result<PlyHeader> readPlyHeader(std::string_view bytes) { return HeaderReader(bytes).read(); }

}  // namespace qmcf
