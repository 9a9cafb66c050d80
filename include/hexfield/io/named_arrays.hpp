#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hexfield {

enum class ElementType { float64, int32, int64, uint8 };

template <class T>
constexpr ElementType element_type();
template <>
constexpr ElementType element_type<double>() {
  return ElementType::float64;
}
template <>
constexpr ElementType element_type<std::int32_t>() {
  return ElementType::int32;
}
template <>
constexpr ElementType element_type<std::int64_t>() {
  return ElementType::int64;
}
template <>
constexpr ElementType element_type<std::uint8_t>() {
  return ElementType::uint8;
}

/// A row-major table of numbers that owns its memory or refers to someone else's.
struct NamedArray {
  ElementType type = ElementType::float64;
  std::size_t rows = 0;
  std::size_t columns = 1;
  const void* data = nullptr;
  std::shared_ptr<const void> owner;  ///< empty when the memory belongs to someone else
};

/// The arrays of one checkpoint group by name.
class NamedArrays {
 public:
  /// Refers to `values` (rows x columns), which must stay where it is while this object is used.
  template <class T>
  void view(const std::string& name, std::span<const T> values, std::size_t columns) {
    arrays_[name] = {element_type<T>(), values.size() / columns, columns, values.data(), nullptr};
  }

  template <class T>
  void own(const std::string& name, std::vector<T> values, std::size_t columns) {
    auto owner = std::make_shared<const std::vector<T>>(std::move(values));
    arrays_[name] = {element_type<T>(), owner->size() / columns, columns, owner->data(), owner};
  }

  void own_text(const std::string& name, const std::string& text);
  std::string text(const std::string& name) const;

  /// The values of an array of this type and number of columns.
  /// Throws Error(bad_input) naming the array when there is none.
  template <class T>
  std::span<const T> get(const std::string& name, std::size_t columns) const {
    const NamedArray& array = find(name, element_type<T>(), columns);
    return {static_cast<const T*>(array.data), array.rows * array.columns};
  }

  bool contains(const std::string& name) const { return arrays_.count(name) != 0; }
  const std::map<std::string, NamedArray>& all() const { return arrays_; }
  void add(const std::string& name, NamedArray array) { arrays_[name] = std::move(array); }

 private:
  const NamedArray& find(const std::string& name, ElementType type, std::size_t columns) const;

  std::map<std::string, NamedArray> arrays_;
};

}  // namespace hexfield
