#include <cholmod.h>
#include <umfpack.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <polyaffine/core/serial_blas.hpp>

#include "polyaffine/solve/linear_system.hpp"

namespace polyaffine {
namespace {

// Lower triangle in compressed columns. The pattern is kept on functions: those coupled to function b are
// b = coupled[start[b]] < ... ; each couple is a 3×3 block, the diagonal one lower triangular.
class SparseSystem : public LinearSystem {
 public:
  SparseSystem(const std::vector<const FieldTable*>& tables, std::vector<char> fixed, bool definite_only)
      : fixed_(std::move(fixed)), definite_only_(definite_only) {
    build_pattern(tables);
    fixed_.resize(columns_.size() - 1, 0);
    cholmod_l_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.print = 0;
    common_.error_handler = nullptr;
    common_.quick_return_if_not_posdef = 1;
  }
  SparseSystem(const SparseSystem&) = delete;
  SparseSystem& operator=(const SparseSystem&) = delete;
  ~SparseSystem() override {
    if (factor_) cholmod_l_free_factor(&factor_, &common_);
    cholmod_l_finish(&common_);
    if (numeric_) umfpack_dl_free_numeric(&numeric_);
  }

  void set_zero() override { std::fill(values_.begin(), values_.end(), 0.0); }

  void add(const std::vector<int>& functions, const Matrix& K) override {
    for (std::size_t b = 0; b < functions.size(); ++b) {
      const int fb = functions[b];
      const int* coupled = coupled_.data() + start_[fb];
      const int* last = coupled_.data() + start_[fb + 1];
      for (std::size_t a = 0; a < functions.size(); ++a) {
        const int fa = functions[a];
        if (fa < fb) continue;
        const std::ptrdiff_t rank = std::lower_bound(coupled, last, fa) - coupled;
        const bool held = holds(fa) || holds(fb);
        for (int j = 0; j < 3; ++j) {
          double* column = values_.data() + columns_[3 * fb + j] + (3 * rank - j);
          const double* from =
              K.col(static_cast<Eigen::Index>(3 * b + j)).data() + static_cast<std::ptrdiff_t>(3 * a);
          for (int i = rank == 0 ? j : 0; i < 3; ++i)
            if (!held || (!fixed_[3 * fa + i] && !fixed_[3 * fb + j])) column[i] += from[i];
        }
      }
    }
  }

  void add_dense(const Matrix&) override {
    throw std::logic_error("sparse system: a pressure space over the whole mesh needs a dense system");
  }

  bool factorise() override {
    const SerialBlas serial;
    for (std::size_t k = 0; k < fixed_.size(); ++k)
      if (fixed_[k]) values_[columns_[k]] = 1;
    if (!std::all_of(values_.begin(), values_.end(), [](double v) { return std::isfinite(v); })) return false;
    cholmod_sparse A = view();
    if (!factor_) factor_ = cholmod_l_analyze(&A, &common_);
    common_.status = CHOLMOD_OK;
    cholmod_l_factorize(&A, factor_, &common_);
    positive_ = common_.status == CHOLMOD_OK && static_cast<std::size_t>(factor_->minor) == factor_->n;
    return positive_ || (!definite_only_ && factorise_indefinite());
  }

  Matrix solve(const Matrix& rhs) const override {
    const SerialBlas serial;
    Matrix x(rhs.rows(), rhs.cols());
    if (!positive_) {
      for (Eigen::Index c = 0; c < rhs.cols(); ++c)
        umfpack_dl_solve(UMFPACK_A, full_columns_.data(), full_rows_.data(), full_values_.data(),
                         x.col(c).data(), rhs.col(c).data(), numeric_, nullptr, nullptr);
      return x;
    }
    cholmod_dense b{};
    b.nrow = b.d = static_cast<std::size_t>(rhs.rows());
    b.ncol = static_cast<std::size_t>(rhs.cols());
    b.nzmax = b.nrow * b.ncol;
    b.x = const_cast<double*>(rhs.data());
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* result = cholmod_l_solve(CHOLMOD_A, factor_, &b, &common_);
    std::copy_n(static_cast<const double*>(result->x), x.size(), x.data());
    cholmod_l_free_dense(&result, &common_);
    return x;
  }

  bool positive_definite() const override { return positive_; }

 private:
  bool holds(int function) const {
    return fixed_[3 * function] || fixed_[3 * function + 1] || fixed_[3 * function + 2];
  }

  void build_pattern(const std::vector<const FieldTable*>& tables) {
    const int n = tables.front()->num_functions;
    std::vector<std::vector<int>> below(n);
    for (int f = 0; f < n; ++f) below[f].push_back(f);
    for (const FieldTable* table : tables)
      for (const auto& block : table->blocks) {
        const std::vector<int> functions = block.functions();
        for (const int b : functions)
          for (const int a : functions)
            if (a > b) below[b].push_back(a);
      }
    start_.push_back(0);
    columns_.push_back(0);
    for (int b = 0; b < n; ++b) {
      std::sort(below[b].begin(), below[b].end());
      below[b].erase(std::unique(below[b].begin(), below[b].end()), below[b].end());
      coupled_.insert(coupled_.end(), below[b].begin(), below[b].end());
      start_.push_back(static_cast<int>(coupled_.size()));
      for (int j = 0; j < 3; ++j) {
        for (const int a : below[b])
          for (int i = a == b ? j : 0; i < 3; ++i) rows_.push_back(3 * a + i);
        columns_.push_back(static_cast<SuiteSparse_long>(rows_.size()));
      }
    }
    values_.assign(rows_.size(), 0.0);
  }

  cholmod_sparse view() {
    cholmod_sparse A{};
    A.nrow = A.ncol = columns_.size() - 1;
    A.nzmax = values_.size();
    A.p = columns_.data();
    A.i = rows_.data();
    A.x = values_.data();
    A.stype = -1;
    A.itype = CHOLMOD_LONG;
    A.xtype = CHOLMOD_REAL;
    A.dtype = CHOLMOD_DOUBLE;
    A.sorted = 1;
    A.packed = 1;
    return A;
  }

  bool factorise_indefinite() {
    cholmod_sparse lower = view();
    cholmod_sparse* full = cholmod_l_copy(&lower, 0, 1, &common_);
    const auto* p = static_cast<const SuiteSparse_long*>(full->p);
    const auto* i = static_cast<const SuiteSparse_long*>(full->i);
    const auto* x = static_cast<const double*>(full->x);
    full_columns_.assign(p, p + full->ncol + 1);
    full_rows_.assign(i, i + p[full->ncol]);
    full_values_.assign(x, x + p[full->ncol]);
    const auto n = static_cast<SuiteSparse_long>(full->ncol);
    cholmod_l_free_sparse(&full, &common_);
    if (numeric_) umfpack_dl_free_numeric(&numeric_);
    numeric_ = nullptr;
    void* symbolic = nullptr;
    if (umfpack_dl_symbolic(n, n, full_columns_.data(), full_rows_.data(), full_values_.data(), &symbolic,
                            nullptr, nullptr) != UMFPACK_OK)
      return false;
    const auto status = umfpack_dl_numeric(full_columns_.data(), full_rows_.data(), full_values_.data(),
                                           symbolic, &numeric_, nullptr, nullptr);
    umfpack_dl_free_symbolic(&symbolic);
    return status == UMFPACK_OK;
  }

  std::vector<char> fixed_;
  bool definite_only_;
  std::vector<int> start_, coupled_;
  std::vector<SuiteSparse_long> columns_, rows_;
  std::vector<double> values_;
  std::vector<SuiteSparse_long> full_columns_, full_rows_;
  std::vector<double> full_values_;
  mutable cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  void* numeric_ = nullptr;
  bool positive_ = false;
};

}  // namespace

std::unique_ptr<LinearSystem> sparse_system(const std::vector<const FieldTable*>& tables,
                                            const std::vector<char>& fixed, bool definite_only) {
  return std::make_unique<SparseSystem>(tables, fixed, definite_only);
}

}  // namespace polyaffine
