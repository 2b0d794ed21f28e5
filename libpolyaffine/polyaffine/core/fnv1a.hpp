#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace polyaffine {

/// The 64-bit FNV-1a checksum of bytes (Fowler, Noll and Vo; draft-eastlake-fnv): quick and well spread, but
/// no protection against a forger.
class Fnv1a {
 public:
  /// Goes on with the bytes of the values, as they lie in memory.
  template <class T>
  void add(std::span<const T> values) {
    for (const std::byte byte : std::as_bytes(values))
      sum_ = (sum_ ^ std::to_integer<std::uint64_t>(byte)) * kPrime;
  }
  std::uint64_t value() const { return sum_; }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3;
  std::uint64_t sum_ = 0xcbf29ce484222325;  // of no bytes
};

}  // namespace polyaffine
