#include "polyaffine/system/field_energy.hpp"

#include <algorithm>
#include <utility>

#include <polyaffine/core/parallel.hpp>
#include <polyaffine/kinematics/block_products.hpp>
#include <polyaffine/material/volumetric_response.hpp>

namespace polyaffine {
namespace {

constexpr int kChunk = 64;  // blocks (slices) whose matrices (forces) are kept before they are added in order
constexpr int kSlicePacks = 8;
constexpr int kSerialPoints = 4096;  // points whose forces one thread computes sooner than it wakes another

void scatter(const std::vector<int>& functions, const Matrix& local, Vector& global) {
  for (std::size_t a = 0; a < functions.size(); ++a)
    global.segment<3>(3 * functions[a]) += local.col(static_cast<Eigen::Index>(a));
}

// As for a dead load.
bool without_tangent(const PackResponse& r) {
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j <= i; ++j)
      for (int lane = 0; lane < kLanes; ++lane)
        if (r.A[i][j][lane] != 0) return false;
  return true;
}

Mat3Pack scaled_cofactor(const Mat3Pack& F, const Pack& factor) {
  Mat3Pack out = cofactor(F);
  for (Pack& entry : out.m) entry *= factor;
  return out;
}

// The numbers of a pack; null where there are none.
const double* of_pack(const Vector& values, int pack) {
  return values.size() > 0 ? values.data() + kLanes * static_cast<std::ptrdiff_t>(pack) : nullptr;
}

template <class Work>
void for_range(bool parallel, int begin, int end, const Work& work) {
  if (parallel)
    parallel_for(begin, end, work);
  else
    for (int k = begin; k < end; ++k) work(k);
}

// Runs work(k, slot) for the blocks of a chunk and then finish(k, slot) in order: the sums do not depend on
// threads.
template <class Work, class Finish>
void for_blocks(bool parallel, int count, const Work& work, const Finish& finish) {
  for (int begin = 0; begin < count; begin += kChunk) {
    const int end = std::min(count, begin + kChunk);
    for_range(parallel, begin, end, [&](int k) { work(k, k - begin); });
    for (int k = begin; k < end; ++k) finish(k, k - begin);
  }
}

// A field over all packs. Its memory is kept by the thread for the next one: megabytes that are returned to
// the system with every residual would be mapped and cleared anew each time.
class PackField {
 public:
  PackField() {
    if (spare().empty()) return;
    data_ = std::move(spare().back());
    spare().pop_back();
  }
  ~PackField() {
    if (!data_.empty()) spare().push_back(std::move(data_));
  }
  PackField(PackField&& other) noexcept : data_(std::move(other.data_)), size_(other.size_) {}
  PackField& operator=(PackField&&) = delete;

  // What it held before may still be there.
  void resize(std::size_t size) {
    size_ = size;
    if (data_.size() < size) data_.resize(size);
  }
  bool empty() const { return size_ == 0; }
  Mat3Pack* data() { return data_.data(); }
  const Mat3Pack& operator[](std::size_t k) const { return data_[k]; }

 private:
  using Data = std::vector<Mat3Pack>;
  static std::vector<Data>& spare() {
    thread_local std::vector<Data> fields;
    return fields;
  }
  Data data_;
  std::size_t size_ = 0;
};

}  // namespace

struct FieldEnergy::Kinematics {
  PackField F, rate;  // of all packs; the rate only where a law feels it
  Vector J;           // det F of all points
  Vector g, p;        // volume constraint and pressure coefficients
};

FieldEnergy::FieldEnergy(FieldTable table, std::vector<std::shared_ptr<const Law>> laws,
                         std::optional<PressureSpace> pressure)
    : table_(std::move(table)), laws_(std::move(laws)), pressure_(std::move(pressure)), first_pack_{0} {
  const auto first =
      std::stable_partition(laws_.begin(), laws_.end(), [](const auto& law) { return !law->feels_rate(); });
  viscous_.assign(first, laws_.end());
  laws_.erase(first, laws_.end());
  if (pressure_) inverse_mass_ = InverseMass(*pressure_, table_);
  for (const auto& block : table_.blocks) {
    packed_.emplace_back(block, table_);
    const int packs = packed_.back().num_packs();
    first_pack_.push_back(first_pack_.back() + packs);
    for (int begin = 0; begin < packs; begin += kSlicePacks)
      slices_.push_back({packed_.size() - 1, {begin, std::min(begin + kSlicePacks, packs)}});
  }
}

// For the fields of a motion, and its pressures where they are given.
FieldEnergy::Kinematics FieldEnergy::room(const Motion& motion) const {
  Kinematics kin;
  kin.F.resize(first_pack_.back());
  if (feels_rate() && motion.rate) kin.rate.resize(first_pack_.back());
  kin.J.resize(table_.num_points());
  if (motion.pressure) kin.p = *motion.pressure;
  return kin;
}

// F, its rate and J in a slice.
void FieldEnergy::move(const Motion& motion, const Slice& slice, Kinematics& kin) const {
  const PackedBlock& block = packed_[slice.block];
  const int at = first_pack_[slice.block] + slice.packs.begin;
  Mat3Pack* F = kin.F.data() + at;
  if (kin.rate.empty())
    block.field(motion.c, true, slice.packs, F);
  else
    block.field_and_rate(motion.c, *motion.rate, slice.packs, F, kin.rate.data() + at);
  for (int p = slice.packs.begin; p < slice.packs.end; ++p, ++F) {
    const Pack J = determinant(*F, cofactor(*F));
    const auto [point, lanes] = block.points(p);
    for (int lane = 0; lane < lanes; ++lane) kin.J[point + lane] = J[lane];
  }
}

FieldEnergy::Kinematics FieldEnergy::kinematics(const Motion& motion) const {
  Kinematics kin = room(motion);
  for_range(table_.num_points() > kSerialPoints, 0, static_cast<int>(slices_.size()),
            [&](int k) { move(motion, slices_[k], kin); });
  if (!pressure_) return kin;
  kin.g = dilatation(*pressure_, table_, kin.J);
  if (!motion.pressure) kin.p = penalty_pressure(kin.g);
  return kin;
}

// Pressure at the points of a slice, filled up to whole packs; empty without a pressure space.
Vector FieldEnergy::point_pressure(const Vector& p, const Slice& slice) const {
  if (!pressure_) return {};
  const auto& space = pressure_->blocks[slice.block];
  const int first = kLanes * slice.packs.begin;
  const int count = std::min(kLanes * slice.packs.size(), table_.blocks[slice.block].count - first);
  Vector out = Vector::Zero(kLanes * slice.packs.size());
  out.head(count).noalias() = space.values.middleCols(first, count).transpose() * p(space.functions);
  return out;
}

// Response of all laws and of the pressure (a number a lane) at one pack, times the integration weights.
void FieldEnergy::respond(const Kinematics& kin, const Motion& motion, std::size_t k, const double* pressure,
                          int pack, bool tangent, double rate_factor, PackResponse& r) const {
  const PackPoints points = packed_[k].points(pack);
  const int at = first_pack_[k] + pack;
  const PackMotion seen{kin.F[at], motion.state, kin.rate.empty() ? nullptr : &kin.rate[at], rate_factor};
  clear(r, tangent);
  for (const auto& law : laws_) {
    if (&law == &laws_.front()) {
      law->respond(points, seen, tangent, r);
      continue;
    }
    PackResponse own;
    clear(own, tangent);
    law->respond(points, seen, tangent, own);
    add(own, tangent, r);
  }
  if (seen.rate)
    for (const auto& law : viscous_) law->respond(points, seen, tangent, r);
  if (pressure_)
    add_volumetric(kin.F[at], cofactor(kin.F[at]), {broadcast(0), load(pressure), broadcast(0)}, tangent, r);
  scale(packed_[k].weight(pack), tangent, r);
}

EnergyValue FieldEnergy::evaluate(const Motion& motion) const {
  // Pressures that follow the displacement are known after a pass over all points; where they are given, or
  // are none, one pass does all.
  const bool two_passes = pressure_ && !motion.pressure;
  Kinematics kin = two_passes ? kinematics(motion) : room(motion);
  EnergyValue out;
  out.gradient = Vector::Zero(table_.num_unknowns());
  std::vector<double> energy(kChunk);
  std::vector<Matrix> force(kChunk);
  for_blocks(
      table_.num_points() > kSerialPoints, static_cast<int>(slices_.size()),
      [&](int k, int slot) {
        const Slice& slice = slices_[k];
        const PackedBlock& block = packed_[slice.block];
        if (!two_passes) move(motion, slice, kin);
        const Vector pressure = point_pressure(kin.p, slice);
        Mat3Pack P[kSlicePacks];
        Pack W = broadcast(0);
        PackResponse r;
        for (int i = 0; i < slice.packs.size(); ++i) {
          respond(kin, motion, slice.block, of_pack(pressure, i), slice.packs.begin + i, false, 0, r);
          W += r.W;
          std::copy(r.P, r.P + 9, P[i].m);
        }
        energy[slot] = sum(W);
        block.force(P, slice.packs, force[slot]);
      },
      [&](int k, int slot) {
        out.value += energy[slot];
        scatter(packed_[slices_[k].block].functions(), force[slot], out.gradient);
      });
  out.min_det = kin.J.minCoeff();
  out.max_det = kin.J.maxCoeff();
  if (!pressure_) return out;
  if (!two_passes) kin.g = dilatation(*pressure_, table_, kin.J);
  out.value += (motion.pressure ? 1.0 : 0.5) * kin.g.dot(kin.p);
  if (!motion.pressure) return out;
  out.pressure_gradient = kin.g;
  if (pressure_->incompressible) return out;
  const Vector strain = pressure_mass(*pressure_, table_, kin.p) / pressure_->bulk_modulus;
  out.value -= 0.5 * kin.p.dot(strain);
  out.pressure_gradient -= strain;
  return out;
}

PointTerms FieldEnergy::point_terms(const Motion& motion) const {
  const Kinematics kin = kinematics(motion);
  PointTerms out;
  out.value.resize(table_.num_points());
  out.gradient = Matrix::Zero(table_.num_unknowns(), table_.num_points());
  if (motion.pressure) out.pressure_gradient = Matrix::Zero(pressure_->num_functions, table_.num_points());
  Matrix rows;
  for (std::size_t k = 0; k < packed_.size(); ++k) {
    const PackedBlock& block = packed_[k];
    const PointBlock& points = table_.blocks[k];
    const Vector pressure = point_pressure(kin.p, whole(k));
    std::vector<Mat3Pack> P(block.num_packs());
    PackResponse r;
    for (int pack = 0; pack < block.num_packs(); ++pack) {
      respond(kin, motion, k, of_pack(pressure, pack), pack, false, 0, r);
      std::copy(r.P, r.P + 9, P[pack].m);
      const auto [point, lanes] = block.points(pack);
      for (int lane = 0; lane < lanes; ++lane) out.value[point + lane] = r.W[lane];
    }
    block_force_rows(block, P.data(), Matrix::Identity(points.count, points.count), rows);
    for (std::size_t a = 0; a < block.functions().size(); ++a)
      out.gradient.block(3 * static_cast<Eigen::Index>(block.functions()[a]), points.first, 3, points.count) =
          rows.middleCols<3>(static_cast<Eigen::Index>(3 * a)).transpose();
    if (!motion.pressure) continue;
    const auto& space = pressure_->blocks[k];
    for (int q = 0; q < points.count; ++q) {
      const int point = points.first + q;
      double change = kin.J[point] - 1;
      if (!pressure_->incompressible) change -= pressure[q] / pressure_->bulk_modulus;
      out.pressure_gradient.col(point)(space.functions) =
          table_.weights[point] * change * space.values.col(q);
    }
  }
  return out;
}

VolumeGradient FieldEnergy::add_tangent(const Motion& motion, LinearSystem& system, double scale,
                                        double rate_factor) const {
  const Motion used{motion.c, motion.state, rate_factor != 0 ? motion.rate : nullptr, motion.pressure};
  const Kinematics kin = kinematics(used);
  const bool global = pressure_ && !inverse_mass_.local();
  VolumeGradient D;
  if (pressure_) D = VolumeGradient(*pressure_, table_, !global);
  std::vector<Matrix> K(kChunk), rows(kChunk);
  for_blocks(
      true, static_cast<int>(packed_.size()),
      [&](int k, int slot) {
        const PackedBlock& block = packed_[k];
        const Vector pressure = point_pressure(kin.p, whole(static_cast<std::size_t>(k)));
        thread_local std::vector<PackResponse> responses;
        responses.resize(block.num_packs());
        for (int pack = 0; pack < block.num_packs(); ++pack) {
          respond(kin, used, k, of_pack(pressure, pack), pack, true, rate_factor, responses[pack]);
          mirror(responses[pack]);
        }
        if (!pressure_ && std::all_of(responses.begin(), responses.end(), without_tangent)) {
          K[slot].resize(0, 0);
          return;
        }
        block_stiffness(block, responses.data(), K[slot]);
        if (scale != 1) K[slot] *= scale;
        if (!pressure_) return;
        std::vector<Mat3Pack> S(block.num_packs());
        for (int pack = 0; pack < block.num_packs(); ++pack)
          S[pack] = scaled_cofactor(kin.F[first_pack_[k] + pack], block.weight(pack));
        block_force_rows(block, S.data(), pressure_->blocks[k].values, rows[slot]);
        if (!global)
          K[slot].noalias() += scale * pressure_->bulk_modulus * rows[slot].transpose() *
                               (inverse_mass_.block(k) * rows[slot]);
      },
      [&](int k, int slot) {
        if (K[slot].size() == 0) return;
        system.add(packed_[k].functions(), K[slot]);
        if (pressure_) D.add(static_cast<std::size_t>(k), *pressure_, std::move(rows[slot]));
      });
  if (global) system.add_gram(inverse_mass_.half(D.whole()), scale * pressure_->bulk_modulus);
  return D;
}

Vector FieldEnergy::pressure(const Vector& c) const {
  return kinematics({c}).p;
}

Vector FieldEnergy::penalty_pressure(const Vector& g) const {
  return pressure_->bulk_modulus * inverse_mass_.apply(g);
}

VolumeGradient FieldEnergy::volume_gradient(const Vector& c) const {
  VolumeGradient out(*pressure_, table_, inverse_mass_.local());
  std::vector<Mat3Pack> S;
  for (std::size_t k = 0; k < packed_.size(); ++k) {
    const PackedBlock& block = packed_[k];
    S.resize(block.num_packs());
    block.field(c, true, block.all(), S.data());
    for (int pack = 0; pack < block.num_packs(); ++pack)
      S[pack] = scaled_cofactor(S[pack], block.weight(pack));
    Matrix rows;
    block_force_rows(block, S.data(), pressure_->blocks[k].values, rows);
    out.add(k, *pressure_, std::move(rows));
  }
  return out;
}

}  // namespace polyaffine
