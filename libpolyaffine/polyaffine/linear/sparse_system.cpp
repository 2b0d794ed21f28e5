#include <cholmod.h>
#include <umfpack.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include <polyaffine/core/serial_blas.hpp>

#include "polyaffine/linear/sparse_system.hpp"

namespace polyaffine {
namespace {

// Lower triangle of unknowns that are numbered anew, function after function, so that Cholesky fills in
// little. The pattern is kept on functions: those coupled to the one at place b are coupled[start[b]] < ... ;
// each couple is a 3×3 block, of which the diagonal ones use the lower triangle. Blocks are summed one after
// the other in memory and then copied to the compressed columns of CHOLMOD.
class SparseSystem : public LinearSystem {
 public:
  SparseSystem(const std::vector<const FieldTable*>& tables, std::vector<char> fixed, bool definite_only,
               const HeldDirections& directions)
      : fixed_(std::move(fixed)), definite_only_(definite_only) {
    fixed_.resize(3 * static_cast<std::size_t>(tables.front()->num_functions), 0);
    cholmod_l_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.print = 0;
    common_.error_handler = nullptr;
    common_.quick_return_if_not_posdef = 1;
    const Couples couples = couples_of(tables);
    place_ = fill_reducing_places(couples);
    build_pattern(couples);
    for (const HeldDirection& h : directions) held_at_[place_[h.function]] = h.direction;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_NATURAL;
    common_.postorder = 0;  // places are in it already
    cholmod_sparse A = view();
    factor_ = cholmod_l_analyze(&A, &common_);
  }
  SparseSystem(const SparseSystem&) = delete;
  SparseSystem& operator=(const SparseSystem&) = delete;
  ~SparseSystem() override {
    if (factor_) cholmod_l_free_factor(&factor_, &common_);
    cholmod_l_finish(&common_);
    if (numeric_) umfpack_dl_free_numeric(&numeric_);
  }

  void set_zero() override { std::fill(blocks_.begin(), blocks_.end(), 0.0); }

  void add(const std::vector<int>& functions, const Matrix& K) override {
    targets_.clear();
    for (int b = 0; b < std::ssize(functions); ++b) {
      const int fb = functions[b], pb = place_[fb];
      const int* coupled = coupled_.data() + start_[pb];
      const int* last = coupled_.data() + start_[pb + 1];
      for (int a = 0; a < std::ssize(functions); ++a) {
        const int fa = functions[a], pa = place_[fa];
        if (pa < pb || held(fa) || held(fb)) continue;
        double* block = blocks_.data() + 9 * (std::lower_bound(coupled, last, pa) - coupled_.data());
        __builtin_prefetch(block, 1);  // spread over megabytes
        __builtin_prefetch(block + 8, 1);
        targets_.push_back({a, b, block});
      }
    }
    for (const auto& [a, b, block] : targets_) Eigen::Map<Mat3>(block) += K.block<3, 3>(3 * a, 3 * b);
  }

  void add_dense(const Matrix&) override {
    throw std::logic_error("sparse system: a pressure space over the whole mesh needs a dense system");
  }

  bool factorise() override {
    const SerialBlas serial;
    if (!held_at_.empty()) hold_directions();
    fill_columns();
    if (!std::all_of(values_.begin(), values_.end(), [](double v) { return std::isfinite(v); })) return false;
    cholmod_sparse A = view();
    common_.status = CHOLMOD_OK;
    cholmod_l_factorize(&A, factor_, &common_);
    positive_ = common_.status == CHOLMOD_OK && static_cast<std::size_t>(factor_->minor) == factor_->n;
    return positive_ || (!definite_only_ && factorise_indefinite());
  }

  Matrix solve(const Matrix& rhs) const override {
    const SerialBlas serial;
    Matrix at_places(rhs.rows(), rhs.cols()), x(rhs.rows(), rhs.cols());
    for (Eigen::Index f = 0; f < std::ssize(place_); ++f)
      at_places.middleRows<3>(3 * place_[f]) = rhs.middleRows<3>(3 * f);
    const Matrix y = positive_ ? solve_definite(at_places) : solve_indefinite(at_places);
    for (Eigen::Index f = 0; f < std::ssize(place_); ++f)
      x.middleRows<3>(3 * f) = y.middleRows<3>(3 * place_[f]);
    return x;
  }

  bool positive_definite() const override { return positive_; }

 private:
  struct Target {
    int a, b;  // of a local matrix
    double* block;
  };
  using Couples = std::vector<std::vector<int>>;  // of function b with b and the functions after it

  bool held(int f) const { return fixed_[3 * f] && fixed_[3 * f + 1] && fixed_[3 * f + 2]; }

  static void sort(Couples& couples) {
    for (auto& list : couples) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }

  Couples couples_of(const std::vector<const FieldTable*>& tables) const {
    Couples out(fixed_.size() / 3);
    for (std::size_t f = 0; f < out.size(); ++f) out[f].push_back(static_cast<int>(f));
    for (const FieldTable* table : tables)
      for (const auto& block : table->blocks) {
        const std::vector<int> functions = block.functions();
        for (const int b : functions)
          for (const int a : functions)
            if (a > b && !held(a) && !held(b)) out[b].push_back(a);
      }
    sort(out);
    return out;
  }

  // The better ordering, of nested dissection and minimum degree, of the graph of functions: it is nine times
  // smaller than that of unknowns.
  std::vector<int> fill_reducing_places(const Couples& couples) {
    const std::size_t n = couples.size();
    std::vector<SuiteSparse_long> columns{0}, rows;
    for (const auto& list : couples) {
      rows.insert(rows.end(), list.begin(), list.end());
      columns.push_back(static_cast<SuiteSparse_long>(rows.size()));
    }
    cholmod_sparse graph = lower_triangle(columns, rows, nullptr);
    common_.nmethods = 2;
    common_.method[0].ordering = CHOLMOD_METIS;
    common_.method[1].ordering = CHOLMOD_AMD;
    cholmod_factor* symbolic = cholmod_l_analyze(&graph, &common_);
    std::vector<int> out(n);
    for (std::size_t k = 0; k < n; ++k)
      out[static_cast<const SuiteSparse_long*>(symbolic->Perm)[k]] = static_cast<int>(k);
    cholmod_l_free_factor(&symbolic, &common_);
    return out;
  }

  void build_pattern(const Couples& couples) {
    Couples placed(couples.size());
    for (std::size_t b = 0; b < couples.size(); ++b)
      for (const int a : couples[b]) {
        const auto [low, high] = std::minmax(place_[a], place_[b]);
        placed[low].push_back(high);
      }
    sort(placed);
    start_.push_back(0);
    columns_.push_back(0);
    for (int b = 0; b < std::ssize(placed); ++b) {
      coupled_.insert(coupled_.end(), placed[b].begin(), placed[b].end());
      start_.push_back(static_cast<int>(coupled_.size()));
      for (int j = 0; j < 3; ++j) {
        for (const int a : placed[b])
          for (int i = a == b ? j : 0; i < 3; ++i) rows_.push_back(3 * a + i);
        columns_.push_back(static_cast<SuiteSparse_long>(rows_.size()));
      }
    }
    values_.assign(rows_.size(), 0.0);
    blocks_.assign(9 * coupled_.size(), 0.0);
    fixed_at_.resize(fixed_.size());
    for (std::size_t f = 0; f < place_.size(); ++f)
      std::copy_n(fixed_.data() + 3 * f, 3, fixed_at_.data() + 3 * static_cast<std::ptrdiff_t>(place_[f]));
  }

  // Of every block K_ab what is left between the free directions, and n nᵀ beside it on the diagonal.
  void hold_directions() {
    const auto direction = [&](int place) -> const Vec3* {
      const auto found = held_at_.find(place);
      return found == held_at_.end() ? nullptr : &found->second;
    };
    for (int b = 0; b + 1 < std::ssize(start_); ++b) {
      const Vec3* nb = direction(b);
      for (int couple = start_[b]; couple < start_[b + 1]; ++couple) {
        const int a = coupled_[couple];
        const Vec3* na = direction(a);
        if (na == nullptr && nb == nullptr) continue;
        Eigen::Map<Mat3> block(blocks_.data() + 9 * static_cast<std::ptrdiff_t>(couple));
        if (na) block -= (*na * (na->transpose() * block)).eval();
        if (nb) block -= ((block * *nb) * nb->transpose()).eval();
        if (a == b && nb) block += *nb * nb->transpose();
      }
    }
  }

  void fill_columns() {
    double* value = values_.data();
    for (std::size_t b = 0; b + 1 < start_.size(); ++b)
      for (std::size_t j = 0; j < 3; ++j) {
        const bool fixed = fixed_at_[3 * b + j];
        for (int couple = start_[b]; couple < start_[b + 1]; ++couple) {
          const double* column = blocks_.data() + 9 * static_cast<std::ptrdiff_t>(couple) + 3 * j;
          const auto a = static_cast<std::size_t>(coupled_[couple]);
          for (std::size_t i = a == b ? j : 0; i < 3; ++i)
            *value++ = fixed || fixed_at_[3 * a + i] ? (a == b && i == j ? 1.0 : 0.0) : column[i];
        }
      }
  }

  static cholmod_sparse lower_triangle(std::vector<SuiteSparse_long>& columns,
                                       std::vector<SuiteSparse_long>& rows, double* values) {
    cholmod_sparse A{};
    A.nrow = A.ncol = columns.size() - 1;
    A.nzmax = rows.size();
    A.p = columns.data();
    A.i = rows.data();
    A.x = values;
    A.stype = -1;
    A.itype = CHOLMOD_LONG;
    A.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
    A.dtype = CHOLMOD_DOUBLE;
    A.sorted = 1;
    A.packed = 1;
    return A;
  }
  cholmod_sparse view() { return lower_triangle(columns_, rows_, values_.data()); }

  Matrix solve_definite(const Matrix& rhs) const {
    cholmod_dense b{};
    b.nrow = b.d = static_cast<std::size_t>(rhs.rows());
    b.ncol = static_cast<std::size_t>(rhs.cols());
    b.nzmax = b.nrow * b.ncol;
    b.x = const_cast<double*>(rhs.data());
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* result = cholmod_l_solve(CHOLMOD_A, factor_, &b, &common_);
    Matrix x(rhs.rows(), rhs.cols());
    std::copy_n(static_cast<const double*>(result->x), x.size(), x.data());
    cholmod_l_free_dense(&result, &common_);
    return x;
  }

  Matrix solve_indefinite(const Matrix& rhs) const {
    Matrix x(rhs.rows(), rhs.cols());
    for (Eigen::Index c = 0; c < rhs.cols(); ++c)
      umfpack_dl_solve(UMFPACK_A, full_columns_.data(), full_rows_.data(), full_values_.data(),
                       x.col(c).data(), rhs.col(c).data(), numeric_, nullptr, nullptr);
    return x;
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
  std::vector<char> fixed_at_;             // the same in the new order
  std::vector<int> place_;                 // of function f in it
  std::unordered_map<int, Vec3> held_at_;  // directions, by place
  std::vector<int> start_, coupled_;
  std::vector<SuiteSparse_long> columns_, rows_;
  std::vector<double> blocks_, values_;
  std::vector<Target> targets_;  // of the matrix that is added
  std::vector<SuiteSparse_long> full_columns_, full_rows_;
  std::vector<double> full_values_;
  mutable cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  void* numeric_ = nullptr;
  bool positive_ = false;
};

}  // namespace

std::unique_ptr<LinearSystem> sparse_system(const std::vector<const FieldTable*>& tables,
                                            const std::vector<char>& fixed, bool definite_only,
                                            const HeldDirections& held) {
  return std::make_unique<SparseSystem>(tables, fixed, definite_only, held);
}

}  // namespace polyaffine
