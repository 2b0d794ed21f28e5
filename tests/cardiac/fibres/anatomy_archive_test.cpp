#include "cardiac/fibres/anatomy_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <random>

#include <cardiac/anatomy/heart_mesh.hpp>
#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/anatomy/right_ventricle.hpp>
#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/fibres/file_fibres.hpp>
#include <cardiac/fibres/helix.hpp>
#include <polyaffine/core/fnv1a.hpp>
#include <polyaffine/mesh_io/read.hpp>
#include <polyaffine/vtk/read.hpp>

#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"
#include "support/whole_file.hpp"

namespace cardiac {
namespace {

using polyaffine::Vec3;
using polyaffine::Vec4;
using polyaffine::testing::error_of;
using ::testing::HasSubstr;

Anatomy small() {
  CurvedMesh curved = structured_ellipsoid(human_lv(), {8, 8, 1});
  AnatomyOptions options;
  options.midpoints = curved.midpoints;
  return make_anatomy(std::move(curved.mesh), options);
}

Anatomy of_mesh(const char* name) {
  return make_anatomy(polyaffine::read_vtu(std::string(PROJECT_DIR "/meshes/") + name, 1));
}

Anatomy back(const Anatomy& anatomy) {
  const TemporaryFolder folder;
  write_anatomy(folder.path / "heart.bin", anatomy);
  return read_anatomy(folder.path / "heart.bin");
}

bool same(const CoordinateSample& a, const CoordinateSample& b) {
  return a.u == b.u && a.t == b.t && a.psi == b.psi && a.w == b.w && a.grad_u == b.grad_u &&
         a.grad_t == b.grad_t && a.grad_psi == b.grad_psi && a.Q == b.Q && a.dQ == b.dQ;
}

/// Everything that an anatomy is asked for, to the last bit.
void expect_same(const Anatomy& a, const Anatomy& b) {
  EXPECT_EQ(a.mesh.points(), b.mesh.points());
  EXPECT_EQ(a.mesh.tets(), b.mesh.tets());
  EXPECT_EQ(a.mesh.regions(), b.mesh.regions());
  EXPECT_EQ(a.mesh.boundary(), b.mesh.boundary());
  EXPECT_EQ(a.mesh.boundary_labels(), b.mesh.boundary_labels());
  EXPECT_EQ(a.mesh.boundary_tets(), b.mesh.boundary_tets());
  EXPECT_EQ(a.mesh.neighbours(), b.mesh.neighbours());
  EXPECT_EQ(a.labels.rv_endo, b.labels.rv_endo);
  EXPECT_EQ(a.segment, b.segment);
  const VentricularCoordinates &c = *a.coordinates, &d = *b.coordinates;
  EXPECT_EQ(c.space().nodes(), d.space().nodes());
  EXPECT_EQ(c.space().elements(), d.space().elements());
  EXPECT_EQ(c.apicobasal(), d.apicobasal());
  EXPECT_EQ(c.arc_length(), d.arc_length());
  EXPECT_EQ(c.cavity_length(), d.cavity_length());
  EXPECT_EQ(c.anterior_assumed(), d.anterior_assumed());
  EXPECT_EQ(c.anterior(), d.anterior());
  EXPECT_EQ(notes_of(c.long_axis()), notes_of(d.long_axis()));
  std::mt19937 random(3);
  std::exponential_distribution<double> spread;
  for (int t = 0; t < a.mesh.num_tets(); ++t) {
    Vec4 at;
    for (double& x : at) x = spread(random);
    at /= at.sum();
    ASSERT_TRUE(same(c.sample(t, at), d.sample(t, at))) << "tet " << t;
    ASSERT_TRUE(same(c.wall_sample(t, at), d.wall_sample(t, at))) << "tet " << t;
    const Vec3 X = c.position(t, at);
    ASSERT_EQ(segment_at(c, t, at, X), segment_at(d, t, at, X)) << "tet " << t;
    ASSERT_EQ(shares_at(c, t, at, 0.3), shares_at(d, t, at, 0.3)) << "tet " << t;
    if (!c.right()) continue;
    ASSERT_EQ(c.right()->border(t, at).share_gradient, d.right()->border(t, at).share_gradient);
    ASSERT_EQ(c.right()->septal(t, at), d.right()->septal(t, at));
    ASSERT_EQ(wall_fibres(c, t, at, {}), wall_fibres(d, t, at, {}));
  }
}

/// Fibres as a mesh file brings them: of tets or of points.
std::shared_ptr<const FileFibres> fibres_on(const Anatomy& anatomy, bool of_tets) {
  polyaffine::MeshFile file{anatomy.mesh};
  (of_tets ? file.cell_fields : file.point_fields)["fibre"] =
      polyaffine::Matrix::Random(3, of_tets ? anatomy.mesh.num_tets() : anatomy.mesh.num_points());
  return std::make_shared<const FileFibres>(file, "heart.vtu");
}

FibreAxes centre_fibres(const Anatomy& anatomy) {
  std::vector<int> tet(anatomy.mesh.num_tets());
  for (std::size_t k = 0; k < tet.size(); ++k) tet[k] = static_cast<int>(k);
  Eigen::Matrix4Xd at = Eigen::Matrix4Xd::Constant(4, std::ssize(tet), 0.2);
  at.row(1).array() += 0.2;
  return anatomy.fibres(*anatomy.coordinates, tet, at);
}

TEST(AnatomyArchive, GivesAnEllipsoidBack) {
  const Anatomy anatomy = small();
  const Anatomy found = back(anatomy);
  expect_same(anatomy, found);
  EXPECT_FALSE(found.fibres);
  EXPECT_FALSE(found.coordinates->right());
}

TEST(AnatomyArchive, GivesTwoVentriclesBack) {
  const Anatomy anatomy = of_mesh("healthy_biv_coarse.vtu");
  const Anatomy found = back(anatomy);
  expect_same(anatomy, found);
  EXPECT_EQ(found.coordinates->right()->base_centre(), anatomy.coordinates->right()->base_centre());
}

TEST(AnatomyArchive, GivesAHeartOfAnotherProgramBack) {
  const std::filesystem::path file = PROJECT_DIR "/../shared/data/hearts/lv_1260.msh";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  const Anatomy anatomy =
      make_anatomy(make_heart_mesh(polyaffine::read_mesh_data(file), nullptr, {}).file.mesh);
  expect_same(anatomy, back(anatomy));
}

TEST(AnatomyArchive, GivesFibresOfAFileBack) {
  Anatomy anatomy = small();
  for (const bool of_tets : {true, false}) {
    anatomy.fibres = FileFibreFunction{fibres_on(anatomy, of_tets)};
    const Anatomy found = back(anatomy);
    EXPECT_EQ(centre_fibres(found), centre_fibres(anatomy));
    EXPECT_EQ(found.fibres.target<FileFibreFunction>()->fibres->description(),
              of_tets ? "fibre of tets, sheet across the wall" : "fibre of points, sheet across the wall");
  }
}

TEST(AnatomyArchive, FibresThatAProgramComputesAreRefused) {
  Anatomy anatomy = small();
  anatomy.fibres = [](const auto&, const auto& tet, const auto&) { return FibreAxes(9, tet.size()); };
  EXPECT_THAT(error_of([&] { back(anatomy); }), HasSubstr("found fibres that a program computes"));
}

TEST(AnatomyArchive, PartsOfDifferentHeartsAreRefused) {
  const Anatomy anatomy = small();
  const auto refusal = [&](const auto& change) {
    Anatomy changed = anatomy;
    change(changed);
    return error_of([&] { back(changed); });
  };
  EXPECT_THAT(refusal([](Anatomy& x) {
                x.mesh = structured_ellipsoid(human_lv(), {8, 8, 2}).mesh;
              }),
              HasSubstr("heart.bin: found an anatomy with coordinates that are not"));
  EXPECT_THAT(refusal([](Anatomy& x) { x.coordinates = nullptr; }), HasSubstr("coordinates that are not"));
  EXPECT_THAT(refusal([](Anatomy& x) { x.labels.rv_endo = 4; }), HasSubstr("numbers of ventricles"));
  EXPECT_THAT(refusal([](Anatomy& x) { x.segment.pop_back(); }), HasSubstr("segments that are not"));
  EXPECT_THAT(refusal([](Anatomy& x) { x.segment[3] = 18; }), HasSubstr("segments that are not"));
  const Anatomy other = of_mesh("healthy_biv_coarse.vtu");
  EXPECT_THAT(refusal([&](Anatomy& x) { x.fibres = FileFibreFunction{fibres_on(other, true)}; }),
              HasSubstr("fibres that are not"));
}

// Bytes of which the checksum fits: read or refused by name, and what was read can be asked.
TEST(AnatomyArchive, AnyBytesAreReadOrRefused) {
  Anatomy anatomy = small();
  anatomy.fibres = FileFibreFunction{fibres_on(anatomy, true)};
  const TemporaryFolder folder;
  const auto file = folder.path / "heart.bin";
  write_anatomy(file, anatomy);
  const std::string bytes = whole_file(file);
  std::mt19937 random(5);
  int refused = 0;
  for (int k = 0; k < 400; ++k) {
    std::string changed = bytes;
    // Mostly the high bytes of numbers, so that indices and lengths leave their range.
    for (unsigned edits = 1 + random() % 3; edits > 0; --edits)
      changed[16 + random() % (changed.size() - 24)] = static_cast<char>(random() % 2 ? random() : 0x7f);
    polyaffine::Fnv1a sum;
    sum.add(std::span<const char>(changed.data(), changed.size() - 8));
    const std::uint64_t value = sum.value();
    std::copy_n(reinterpret_cast<const char*>(&value), 8, changed.end() - 8);
    std::filesystem::remove(file);
    std::ofstream(file, std::ios::binary) << changed;
    const std::string error = error_of([&] {
      const Anatomy found = read_anatomy(file);
      for (int t = 0; t < found.mesh.num_tets(); ++t) found.coordinates->wall_sample(t, Vec4::Constant(0.25));
      centre_fibres(found);
    });
    refused += error != "no error";
    if (error != "no error") {
      ASSERT_THAT(error, HasSubstr("heart.bin: ")) << k;
    }
  }
  EXPECT_GT(refused, 20);
  EXPECT_LT(refused, 380);
}

// Reading costs no solve: of the processor's time of building anew a small part, whatever the machine.
TEST(AnatomyArchive, ReadingIsMuchQuickerThanBuilding) {
  const auto seconds = [](const auto& action) {
    const std::clock_t begin = std::clock();
    action();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  const TemporaryFolder folder;
  for (const char* name : {"healthy_lv.vtu", "healthy_biv.vtu"}) {
    Anatomy anatomy;
    const double built = seconds([&] { anatomy = of_mesh(name); });
    write_anatomy(folder.path / "heart.bin", anatomy);
    const double read = seconds([&] { read_anatomy(folder.path / "heart.bin"); });
    EXPECT_LT(read, built / 4) << name << ": read in " << read << " s, built in " << built << " s";
  }
}

}  // namespace
}  // namespace cardiac
