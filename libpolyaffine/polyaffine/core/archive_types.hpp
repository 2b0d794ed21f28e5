#pragma once

#include <array>
#include <concepts>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <polyaffine/core/archive.hpp>

// The types that archives know: numbers, enumerations and bool; strings, vectors, arrays, pairs, optionals
// and maps of known types; shared pointers (what several point to is stored once); matrices, vectors and
// arrays of Eigen, dense ones of any size and sparse ones. A number or enumeration is stored at its width:
// use int, double and the types of fixed width, not long.

namespace polyaffine {

template <class Archive, ArchivedNumber T>
void archive(Archive& a, T& x) {
  a.bytes(&x, sizeof(T));
}

template <class Archive, class T>
requires std::is_enum_v<T>
void archive(Archive& a, T& x) {
  auto number = static_cast<std::underlying_type_t<T>>(x);
  a(number);
  if constexpr (Archive::kReading) x = static_cast<T>(number);
}

template <class Archive, std::same_as<bool> T>
void archive(Archive& a, T& x) {
  std::uint8_t number = x;
  a(number);
  if constexpr (Archive::kReading) {
    if (number > 1) a.refuse("found the truth value " + std::to_string(number) + ", expected 0 or 1");
    x = number == 1;
  }
}

template <class Archive>
void archive(Archive& a, std::string& x) {
  const auto count = a.length(x.size(), 1);
  if constexpr (Archive::kReading) x.resize(count);
  a.bytes(x.data(), count);
}

template <class Archive, class T>
void archive(Archive& a, std::vector<T>& x) {
  if constexpr (ArchivedNumber<T>) {
    const auto count = a.length(x.size(), sizeof(T));
    if constexpr (Archive::kReading) x.resize(count);
    a.bytes(x.data(), count * sizeof(T));
  } else if constexpr (Archive::kReading) {
    x.clear();
    for (auto left = a.length(0, 1); left > 0; --left) {
      T element = ArchiveAccess::make<T>();
      a(element);
      x.push_back(std::move(element));
    }
  } else {
    a.length(x.size(), 1);
    for (const auto& element : std::as_const(x)) a(element);
  }
}

template <class Archive, class T, std::size_t n>
void archive(Archive& a, std::array<T, n>& x) {
  for (T& element : x) a(element);
}

template <class Archive, class First, class Second>
void archive(Archive& a, std::pair<First, Second>& x) {
  a(x.first, x.second);
}

template <class Archive, class T>
void archive(Archive& a, std::optional<T>& x) {
  bool there = x.has_value();
  a(there);
  if constexpr (Archive::kReading) x = there ? std::optional<T>(ArchiveAccess::make<T>()) : std::nullopt;
  if (there) a(*x);
}

template <class Archive, class Key, class T>
void archive(Archive& a, std::map<Key, T>& x) {
  std::vector<std::pair<Key, T>> entries;
  if constexpr (!Archive::kReading) entries.assign(x.begin(), x.end());
  a(entries);
  if constexpr (Archive::kReading) {
    x.clear();
    for (auto& entry : entries)
      if (!x.insert(std::move(entry)).second) a.refuse("found a key of a map twice, expected it once");
  }
}

template <class Archive, class T>
void archive(Archive& a, std::shared_ptr<T>& x) {
  a.shared(x);
}

/// Visits the members of x, or x itself.
template <class Archive, class T>
void visit(Archive& a, T& x) {
  if constexpr (requires { ArchiveAccess::members(a, x); })
    ArchiveAccess::members(a, x);
  else
    archive(a, x);
}

}  // namespace polyaffine
