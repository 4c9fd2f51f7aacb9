#include <algorithm>
#include <string>
#include <utility>

#include "polygon_soup.hpp"
#include "text_cursor.hpp"

namespace qmcf {

void LabelTable::set(std::size_t part, std::string_view name) {
  anySet_ = true;
  currentLabel_ = kNone;
  textSize_ += name.size() + 2;
  if (name.empty()) {
    current_[part] = kNone;
    return;
  }
  const auto [entry, isNew] = partIds_.try_emplace(name, static_cast<std::int32_t>(partNames_.size()));
  if (isNew) partNames_.push_back(name);
  current_[part] = entry->second;
}

void LabelTable::labelFace() {
  if (currentLabel_ == kNone) {
    const auto [entry, isNew] = labelIds_.try_emplace(current_, static_cast<std::int32_t>(labels_.size()));
    if (isNew) labels_.push_back(current_);
    currentLabel_ = entry->second;
  }
  faceLabels_.push_back(currentLabel_);
}

std::string LabelTable::composeName(const std::array<std::int32_t, kParts>& parts) const {
  std::string name;
  for (std::size_t i = 0; i < kParts; ++i) {
    if (parts[i] == kNone || (i > 0 && parts[i] == parts[i - 1])) continue;
    if (!name.empty()) name += '/';
    name += cleanName(partNames_[static_cast<std::size_t>(parts[i])]);
  }
  return name.empty() ? "default" : name;
}

void LabelTable::finish(PolygonSoup& soup) {
  if (!anySet_) return;
  // One long name may be part of very many labels: past the size of the names in the file, labels are only numbered.
  std::size_t budget = 4096 + 2 * textSize_;
  soup.labelNames.reserve(labels_.size());
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    std::string name = budget > 0 ? composeName(labels_[i]) : "label " + std::to_string(i + 1);
    budget -= std::min(budget, name.size());
    soup.labelNames.push_back(std::move(name));
  }
  soup.labels = std::move(faceLabels_);
}

Error lineError(ErrorCode code, std::int64_t line, const std::string& sentence) {
  return {code, "Line " + std::to_string(line) + ": " + sentence, {line}};
}

Error tooLargeError(const char* what) {
  return {ErrorCode::tooLarge,
          std::string("The file has more than 2147483647 ") + what + "; split it into smaller parts.",
          {}};
}

}  // namespace qmcf
