#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace qmcf {

/// The index that stands for "none" in plain buffers.
inline constexpr std::int32_t kNone = -1;

/// A strong index: a vertex can't be taken for a triangle. Invalid (-1) by default.
template <class Tag>
struct Id {
  std::int32_t value = kNone;

  constexpr Id() = default;
  constexpr explicit Id(std::int32_t v) : value(v) {}
  constexpr explicit Id(std::size_t v) : value(static_cast<std::int32_t>(v)) {}
  [[nodiscard]] constexpr bool valid() const { return value >= 0; }
  [[nodiscard]] constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
  friend constexpr auto operator<=>(Id, Id) = default;
};

using VertexId = Id<struct VertexTag>;
using HalfedgeId = Id<struct HalfedgeTag>;
using TriangleId = Id<struct TriangleTag>;

/// An array with one entry per element of one kind, indexed by that kind's id.
template <class Key, class T>
class IdMap {
 public:
  IdMap() = default;
  explicit IdMap(std::size_t size, const T& value = T{}) : data_(size, value) {}

  T& operator[](Key key) { return data_[key.index()]; }
  const T& operator[](Key key) const { return data_[key.index()]; }
  [[nodiscard]] std::size_t size() const { return data_.size(); }
  [[nodiscard]] bool empty() const { return data_.empty(); }
  void resize(std::size_t size, const T& value = T{}) { data_.resize(size, value); }
  void push_back(T value) { data_.push_back(std::move(value)); }
  [[nodiscard]] Key end() const { return Key(data_.size()); }
  std::vector<T>& raw() { return data_; }
  const std::vector<T>& raw() const { return data_; }
  friend bool operator==(const IdMap& a, const IdMap& b) = default;

 private:
  std::vector<T> data_;
};

/// Iterates over all ids in [0, count): for (VertexId v : IdRange<VertexId>(n)).
template <class Key>
class IdRange {
 public:
  class Iterator {
   public:
    explicit constexpr Iterator(std::int32_t v) : value_(v) {}
    constexpr Key operator*() const { return Key(value_); }
    constexpr Iterator& operator++() {
      ++value_;
      return *this;
    }
    friend constexpr bool operator==(Iterator, Iterator) = default;

   private:
    std::int32_t value_;
  };

  explicit constexpr IdRange(std::size_t count) : count_(static_cast<std::int32_t>(count)) {}
  [[nodiscard]] constexpr Iterator begin() const { return Iterator(0); }
  [[nodiscard]] constexpr Iterator end() const { return Iterator(count_); }

 private:
  std::int32_t count_;
};

}  // namespace qmcf
