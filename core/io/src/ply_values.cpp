#include "ply_values.hpp"

#include <limits>

#include "qmcf/base/bits.hpp"

namespace qmcf {

PlyValueState PlyValueReader::nextAscii(double& value) {
  cursor_.skipSpace();
  switch (cursor_.real(value)) {
    case NumberState::ok:
      return PlyValueState::ok;
    case NumberState::missing:
      return PlyValueState::ended;
    case NumberState::nonFinite:
      value = std::numeric_limits<double>::quiet_NaN();
      cursor_.advance(cursor_.token().size());
      return PlyValueState::ok;
    case NumberState::malformed:
      break;
  }
  return PlyValueState::malformed;
}

PlyValueState PlyValueReader::nextBinary(PlyType type, double& value) {
  const std::size_t size = plyTypeSize(type);
  if (data_.size() - offset_ < size) return PlyValueState::ended;
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t place = encoding_ == PlyEncoding::bigEndian ? i : size - 1 - i;
    bits = bits << 8U | static_cast<unsigned char>(data_[offset_ + place]);
  }
  offset_ += size;
  switch (type) {
    case PlyType::int8:
      value = static_cast<double>(static_cast<std::int8_t>(bits));
      break;
    case PlyType::int16:
      value = static_cast<double>(static_cast<std::int16_t>(bits));
      break;
    case PlyType::int32:
      value = static_cast<double>(static_cast<std::int32_t>(bits));
      break;
    case PlyType::float32:
      value = static_cast<double>(bitCast<float>(static_cast<std::uint32_t>(bits)));
      break;
    case PlyType::float64:
      value = bitCast<double>(bits);
      break;
    case PlyType::uint8:
    case PlyType::uint16:
    case PlyType::uint32:
      value = static_cast<double>(bits);
      break;
  }
  return PlyValueState::ok;
}

}  // namespace qmcf
