#include "polyaffine/kinematics/frame_basis.hpp"

#include <algorithm>

#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

double power(double x, int n) {
  double out = 1;
  for (int i = 0; i < n; ++i) out *= x;
  return out;
}

// m(ξ) and ∂m/∂ξ.
std::pair<double, Vec3> evaluate(const Monomial& m, const Vec3& xi) {
  const Vec3 factor(power(xi[0], m[0]), power(xi[1], m[1]), power(xi[2], m[2]));
  Vec3 derivative = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (m[k] > 0) derivative[k] = m[k] * power(xi[k], m[k] - 1) * factor[(k + 1) % 3] * factor[(k + 2) % 3];
  return {factor.prod(), derivative};
}

}  // namespace

Monomial parse_monomial(const std::string& text) {
  Monomial m{0, 0, 0};
  if (text == "1") return m;
  const std::string letters = "lct";
  for (const char ch : text) {
    const auto k = letters.find(ch);
    if (k == std::string::npos)
      throw InputError("enrichment function: found \"" + text +
                       "\", expected \"1\" or a product of l, c, t such as \"tt\" or \"lt\"");
    ++m[k];
  }
  if (text.empty() || text.size() > 4)
    throw InputError("enrichment function: found \"" + text + "\", expected one to four letters");
  return m;
}

std::vector<Monomial> affine_monomials() {
  return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
}

FrameBasis::FrameBasis(std::shared_ptr<const FrameField> field, std::vector<FrameFunctions> frames)
    : field_(std::move(field)), frames_(std::move(frames)) {
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    first_function_.push_back(static_cast<int>(function_frame_.size()));
    function_frame_.insert(function_frame_.end(), frames_[i].monomials.size(), static_cast<int>(i));
  }
}

BasisSample FrameBasis::sample(int tet, const Vec4& barycentric) const {
  const FramesAtPoint at = field_->sample(tet, barycentric);
  std::size_t n = 0;
  for (const auto& f : at.frames) n += frames_[f.frame].monomials.size();
  BasisSample out;
  out.Q = at.Q;
  out.dQ = at.dQ;
  out.N.resize(static_cast<Eigen::Index>(n));
  out.gradient.resize(3, static_cast<Eigen::Index>(n));
  Eigen::Index k = 0;
  for (const auto& f : at.frames) {
    int index = first_function_[f.frame];
    for (const Monomial& monomial : frames_[f.frame].monomials) {
      const auto [value, derivative] = evaluate(monomial, f.xi);
      out.functions.push_back(index++);
      out.N[k] = f.weight * value;
      out.gradient.col(k) = value * f.weight_gradient + f.weight * (f.xi_gradient.transpose() * derivative);
      ++k;
    }
  }
  return out;
}

int FrameBasis::function(int frame, const Monomial& monomial) const {
  const auto& monomials = frames_[frame].monomials;
  const auto it = std::find(monomials.begin(), monomials.end(), monomial);
  return it == monomials.end() ? -1 : first_function_[frame] + static_cast<int>(it - monomials.begin());
}

Matrix frame_values(const FrameField& field, const std::vector<std::vector<Monomial>>& monomials,
                    const std::vector<int>& tet, const Eigen::Matrix4Xd& barycentric) {
  std::vector<int> first{0};
  for (const auto& m : monomials) first.push_back(first.back() + static_cast<int>(m.size()));
  Matrix values = Matrix::Zero(first.back(), barycentric.cols());
  for (Eigen::Index p = 0; p < barycentric.cols(); ++p)
    for (const auto& f : field.sample(tet[p], barycentric.col(p)).frames)
      for (std::size_t m = 0; m < monomials[f.frame].size(); ++m)
        values(first[f.frame] + static_cast<int>(m), p) =
            f.weight * evaluate(monomials[f.frame][m], f.xi).first;
  return values;
}

}  // namespace polyaffine
