#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <string>
#include <vector>

#include <polyaffine/core/archive_types.hpp>
#include <polyaffine/core/types.hpp>

// What archives know of Eigen: dense matrices, vectors and arrays of any size, sparse matrices.

namespace polyaffine {

template <class Archive, class Derived>
void archive(Archive& a, Eigen::PlainObjectBase<Derived>& x) {
  using Scalar = typename Derived::Scalar;
  static_assert(ArchivedNumber<Scalar>);
  std::uint64_t rows = x.rows(), cols = x.cols();
  if constexpr (Derived::RowsAtCompileTime == Eigen::Dynamic) rows = a.length(rows, 0);
  if constexpr (Derived::ColsAtCompileTime == Eigen::Dynamic) cols = a.length(cols, 0);
  if constexpr (Archive::kReading) {
    const auto above = [](std::uint64_t n, int most) { return most >= 0 && n > static_cast<unsigned>(most); };
    if (above(rows, Derived::MaxRowsAtCompileTime) || above(cols, Derived::MaxColsAtCompileTime) ||
        (rows > 0 && cols > a.left() / sizeof(Scalar) / rows))
      a.refuse("found a matrix of " + std::to_string(rows) + " × " + std::to_string(cols) +
               " numbers, expected no more than its type and the " + std::to_string(a.left()) +
               " bytes that are left hold");
    x.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(cols));
  }
  a.bytes(x.data(), rows * cols * sizeof(Scalar));
}

/// Has a compressed sparse matrix its entries in place and in order?
template <class Scalar, class Index>
bool is_sound(std::uint64_t inner, const std::vector<Index>& starts, const std::vector<Index>& places,
              const std::vector<Scalar>& values) {
  const auto end = static_cast<Index>(places.size());
  if (starts.front() != 0 || starts.back() != end || values.size() != places.size()) return false;
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    if (starts[k] > starts[k + 1] || starts[k + 1] > end) return false;
    for (Index j = starts[k]; j < starts[k + 1]; ++j)
      if (places[j] < 0 || static_cast<std::uint64_t>(places[j]) >= inner ||
          (j > starts[k] && places[j - 1] >= places[j]))
        return false;
  }
  return true;
}

template <class Archive, class Scalar, int options, class Index>
void archive(Archive& a, Eigen::SparseMatrix<Scalar, options, Index>& x) {
  using Sparse = Eigen::SparseMatrix<Scalar, options, Index>;
  std::vector<Index> starts, places;
  std::vector<Scalar> values;
  if constexpr (!Archive::kReading) {
    Sparse packed = x;
    packed.makeCompressed();
    starts.assign(packed.outerIndexPtr(), packed.outerIndexPtr() + packed.outerSize() + 1);
    places.assign(packed.innerIndexPtr(), packed.innerIndexPtr() + packed.nonZeros());
    values.assign(packed.valuePtr(), packed.valuePtr() + packed.nonZeros());
  }
  const std::uint64_t inner = a.length(x.innerSize(), 0);
  a(starts, places, values);
  if constexpr (Archive::kReading) {
    if (starts.empty() || !is_sound(inner, starts, places, values))
      a.refuse("found a sparse matrix whose entries are out of place, expected them in order");
    const auto across = static_cast<Eigen::Index>(inner), along = std::ssize(starts) - 1;
    const bool by_rows = Sparse::IsRowMajor;
    x.resize(by_rows ? along : across, by_rows ? across : along);
    x.resizeNonZeros(std::ssize(values));  // an assignment would reserve by rows and columns
    std::ranges::copy(starts, x.outerIndexPtr());
    std::ranges::copy(places, x.innerIndexPtr());
    std::ranges::copy(values, x.valuePtr());
  }
}

/// Stores a matrix at half the bytes, rounded to single precision: a(single(matrix)).
template <class Dense>
struct Single {
  Dense& matrix;
};
template <class Dense>
Single<Dense> single(Dense& matrix) {
  return {matrix};
}
template <class Archive, class Dense>
void archive(Archive& a, Single<Dense>& x) {
  auto rounded = x.matrix.template cast<float>().eval();
  a(rounded);
  if constexpr (Archive::kReading) x.matrix = rounded.template cast<double>();
}

}  // namespace polyaffine
