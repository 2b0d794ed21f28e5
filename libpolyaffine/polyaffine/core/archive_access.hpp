#pragma once

#include <concepts>
#include <type_traits>

namespace polyaffine {

/// Stored as it lies in memory.
template <class T>
concept ArchivedNumber = std::is_arithmetic_v<T> && !std::same_as<T, bool> && !std::same_as<T, long double>;

/// Lets archives make values and visit private members: a class with a private
///
///   friend class polyaffine::ArchiveAccess;
///   template <class Archive>
///   void archive(Archive& a) { a(first_, second_); }
///
/// and a (private) constructor without arguments can be written to and read from archives (archive.hpp).
class ArchiveAccess {
 public:
  template <class T>
  static T make() {
    return T();
  }
  template <class T>
  static T* make_new() {
    return new T();
  }
  /// x.archive(a), where there is one.
  template <class Archive, class T>
  static auto members(Archive& a, T& x) -> decltype(x.archive(a)) {
    return x.archive(a);
  }
};

}  // namespace polyaffine
