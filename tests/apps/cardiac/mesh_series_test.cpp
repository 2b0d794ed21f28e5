#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <Eigen/LU>
#include <fstream>
#include <map>
#include <sstream>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A wall that is filled and contracts, excited from one place, with a late region.
const char* const kProtocol = R"([mesh]
file = "MESH"
length_unit = "mm"
[tissue]
law = "guccione"
C_kPa = 2.0
bf = 8.0
bt = 2.0
bfs = 4.0
bulk_modulus_kPa = 200.0
[fibres]
[activation]
mode = "sites"
onset_ms = 0
site_segments = [8]
[contraction]
contractility_kPa = 8.0
[cavities]
pressure_mmHg = 5.0
[[region]]
name = "late"
segments = [11]
activation_delay_ms = 150.0
[time]
duration_ms = 800
load_steps = 4
[output]
interval_ms = 200.0
figures = false
)";

using Grid = vtkSmartPointer<vtkUnstructuredGrid>;

Grid read(const fs::path& file) {
  auto reader = vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::vector<std::map<std::string, std::string>> table(const fs::path& file) {
  std::istringstream text(whole_file(file));
  std::string line, cell;
  std::vector<std::string> header;
  std::vector<std::map<std::string, std::string>> out;
  std::getline(text, line);
  for (std::istringstream row(line); std::getline(row, cell, ',');) header.push_back(cell);
  while (std::getline(text, line)) {
    std::size_t k = 0;
    auto& row = out.emplace_back();
    for (std::istringstream cells(line); std::getline(cells, cell, ',') && k < header.size();)
      row[header[k++]] = cell;
  }
  return out;
}

Vector3d tuple(vtkDataArray* array, vtkIdType i) {
  Vector3d out;
  array->GetTuple(i, out.data());
  return out;
}

class MeshSeries : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    std::string text = kProtocol;
    text.replace(text.find("MESH"), 4, PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu");
    std::ofstream(folder_->path / "p.toml") << text;
    const ProgramRun run =
        run_program("run " + (folder_->path / "p.toml").string() + " --quiet --out " + out().string());
    ASSERT_EQ(run.status, 0) << run.err;
    first_ = read(out() / "heart_0000.vtu");
    contracted_ = read(name(1));  // contracted; at 800 ms the wall is as it was
  }
  static void TearDownTestSuite() {
    first_ = contracted_ = nullptr;
    delete folder_;
  }
  static fs::path out() { return folder_->path / "out"; }
  static fs::path name(int k) { return out() / ("heart_000" + std::to_string(k) + ".vtu"); }

  /// Edges of a tet in the mesh (points less displacement) or where they are.
  static Matrix3d edges(const Grid& grid, vtkIdType cell, bool in_mesh) {
    vtkIdType count = 0;
    const vtkIdType* corner = nullptr;
    grid->GetCellPoints(cell, count, corner);
    vtkDataArray* u = grid->GetPointData()->GetArray("displacement_mm");
    const auto at = [&](int k) {
      Vector3d x;
      grid->GetPoint(corner[k], x.data());
      return Vector3d(in_mesh ? x - tuple(u, corner[k]) : x);
    };
    Matrix3d out;
    for (int k = 0; k < 3; ++k) out.col(k) = at(k + 1) - at(0);
    return out;
  }

  static inline TemporaryFolder* folder_ = nullptr;
  static inline Grid first_, contracted_;
};

TEST_F(MeshSeries, NamesComponentsSegmentsAndTime) {
  for (const char* field : {"strain_lcr", "segment_strain_lcr"}) {
    vtkDataArray* strain = contracted_->GetCellData()->GetArray(field);
    ASSERT_NE(strain, nullptr) << field;
    ASSERT_EQ(strain->GetNumberOfComponents(), 3);
    EXPECT_STREQ(strain->GetComponentName(0), "longitudinal");
    EXPECT_STREQ(strain->GetComponentName(1), "circumferential");
    EXPECT_STREQ(strain->GetComponentName(2), "radial");
  }
  EXPECT_NE(vtkIntArray::SafeDownCast(contracted_->GetCellData()->GetArray("segment")), nullptr);
  auto* names = vtkStringArray::SafeDownCast(contracted_->GetFieldData()->GetAbstractArray("segment_name"));
  ASSERT_NE(names, nullptr);
  ASSERT_EQ(names->GetNumberOfValues(), 17);
  EXPECT_EQ(names->GetValue(0), "basal anterior");
  EXPECT_EQ(names->GetValue(16), "apex");
  EXPECT_EQ(contracted_->GetFieldData()->GetArray("time_ms")->GetTuple1(0), 200);
  EXPECT_NE(whole_file(out() / "heart.pvd").find("time in ms"), std::string::npos);
}

// The time of excitation from one place differs within a segment; a mean over it would not.
TEST_F(MeshSeries, ActivationIsThatOfTheVertices) {
  vtkDataArray* time = contracted_->GetPointData()->GetArray("activation_ms");
  ASSERT_NE(time, nullptr);
  std::map<int, std::pair<double, double>> range;
  std::map<int, double> sum, corners;
  for (vtkIdType c = 0; c < contracted_->GetNumberOfCells(); ++c) {
    if (contracted_->GetCellType(c) != 10) continue;
    vtkIdType count = 0;
    const vtkIdType* corner = nullptr;
    contracted_->GetCellPoints(c, count, corner);
    const int s = static_cast<int>(contracted_->GetCellData()->GetArray("segment")->GetTuple1(c));
    auto& [low, high] = range.try_emplace(s, 1e9, -1e9).first->second;
    for (int k = 0; k < 4; ++k) {
      low = std::min(low, time->GetTuple1(corner[k]));
      high = std::max(high, time->GetTuple1(corner[k]));
      sum[s] += time->GetTuple1(corner[k]);
      ++corners[s];
    }
  }
  EXPECT_NEAR(range.at(8).first, 0, 1e-9);  // the site itself
  EXPECT_GT(range.at(8).second, 5);         // 5 mm at less than a millimetre in a millisecond
  // The region's delay, but for its border and the way of the wave.
  EXPECT_GT(sum.at(11) / corners.at(11), sum.at(10) / corners.at(10) + 80);
}

TEST_F(MeshSeries, FibresTurnWithTheWall) {
  vtkDataArray* before = first_->GetCellData()->GetArray("fibre");
  vtkDataArray* after = contracted_->GetCellData()->GetArray("fibre");
  double largest = 0;
  for (vtkIdType c = 0; c < contracted_->GetNumberOfCells(); ++c) {
    if (contracted_->GetCellType(c) != 10) continue;
    const auto in_mesh = [&](const Grid& grid, vtkDataArray* fibre) {
      const Matrix3d F = edges(grid, c, false) * edges(grid, c, true).inverse();
      EXPECT_NEAR(tuple(fibre, c).norm(), 1, 1e-6);  // single precision
      return Vector3d((F.inverse() * tuple(fibre, c)).normalized());
    };
    EXPECT_LT((in_mesh(first_, before) - in_mesh(contracted_, after)).norm(), 1e-5);
    largest = std::max(largest, (tuple(before, c) - tuple(after, c)).norm());
  }
  EXPECT_GT(largest, 0.02);
}

// The volume-weighted mean of the tets of a segment is near that of its integration points; within a segment
// the tets differ.
TEST_F(MeshSeries, StrainIsThatOfEachTet) {
  vtkDataArray* own = contracted_->GetCellData()->GetArray("strain_lcr");
  vtkDataArray* of_segment = contracted_->GetCellData()->GetArray("segment_strain_lcr");
  std::map<int, Vector3d> sum, mean;
  std::map<int, double> volume;
  double spread = 0;
  for (vtkIdType c = 0; c < contracted_->GetNumberOfCells(); ++c) {
    if (contracted_->GetCellType(c) != 10) continue;
    const int s = static_cast<int>(contracted_->GetCellData()->GetArray("segment")->GetTuple1(c));
    const double v = edges(contracted_, c, true).determinant() / 6;
    sum.try_emplace(s, Vector3d::Zero()).first->second += v * tuple(own, c);
    volume[s] += v;
    mean[s] = tuple(of_segment, c);
    spread = std::max(spread, (tuple(own, c) - mean[s]).norm());
  }
  // In the apex axes turn fast from tet to tet.
  for (const auto& [s, total] : sum)
    EXPECT_LT((total / volume[s] - mean[s]).norm(), s == 17 ? 0.12 : 0.03) << "segment " << s;
  EXPECT_GT(spread, 0.05);
}

// What a reader of the files does: the map of affine.csv with the node and axes of control_nodes.csv moves
// the vertices of the first frame (end diastole, here the filled wall) to those of the other, but for the
// misfit.
TEST_F(MeshSeries, AffineTableRebuildsTheMotionOfTheFiles) {
  const auto affine = table(out() / "affine.csv");
  const auto nodes = table(out() / "control_nodes.csv");
  ASSERT_EQ(nodes.size(), 17U);
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    const auto value = [](const std::map<std::string, std::string>& row, const std::string& column) {
      return std::stod(row.at(column));
    };
    const auto& row = affine[nodes.size() + s];
    EXPECT_EQ(value(row, "time_ms"), 200);
    Matrix3d A, R;
    Vector3d t, q;
    for (int i = 0; i < 3; ++i) {
      const std::string n = std::to_string(i + 1);
      t[i] = value(row, "t_" + n + "_mm");
      q[i] = value(nodes[s], std::string(1, "xyz"[i]) + "_mm");
      for (int j = 0; j < 3; ++j) {
        A(i, j) = value(row, "a_" + n + std::to_string(j + 1));
        R(i, j) = value(nodes[s], std::string(1, "lcr"[j]) + "_" + "xyz"[i]);
      }
    }
    EXPECT_NEAR(value(row, "determinant"), A.determinant(), 1e-7);
    double off = 0, motion = 0;
    for (vtkIdType c = 0; c < contracted_->GetNumberOfCells(); ++c) {
      if (contracted_->GetCellType(c) != 10 ||
          contracted_->GetCellData()->GetArray("segment")->GetTuple1(c) != static_cast<double>(s + 1))
        continue;
      vtkIdType count = 0;
      const vtkIdType* corner = nullptr;
      contracted_->GetCellPoints(c, count, corner);
      const double v = edges(contracted_, c, true).determinant();
      // Exact for a linear field: the four corners and, with 16 times their weight, the centre.
      Vector3d y_sum = Vector3d::Zero(), x_sum = Vector3d::Zero();
      const auto add = [&](const Vector3d& y, const Vector3d& x, double w) {
        off += w * (q + R * (A * R.transpose() * (y - q) + t) - x).squaredNorm();
        motion += w * (x - y).squaredNorm();
      };
      for (int k = 0; k < 4; ++k) {
        Vector3d y, x;
        first_->GetPoint(corner[k], y.data());
        contracted_->GetPoint(corner[k], x.data());
        add(y, x, v);
        y_sum += y;
        x_sum += x;
      }
      add(y_sum / 4, x_sum / 4, 16 * v);
    }
    // End diastole is the onset of contraction, the mesh that of time 0: the same to the solver's tolerance.
    EXPECT_NEAR(std::sqrt(off / motion), value(row, "misfit"), 5e-6) << "segment " << s + 1;
    EXPECT_GT(motion, 0);
  }
}

}  // namespace
