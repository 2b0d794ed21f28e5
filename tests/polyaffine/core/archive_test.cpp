#include "polyaffine/core/archive_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include <polyaffine/core/fnv1a.hpp>

#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace polyaffine {
namespace {

using ::testing::AllOf;
using testing::error_of;
using ::testing::HasSubstr;

const ArchiveFormat kFormat{"test things", 3};

enum class Colour : std::uint8_t { red, green };

/// Of a class that cannot be made from outside without values.
class Hidden {
 public:
  explicit Hidden(std::string name) : name_(std::move(name)) {}
  bool operator==(const Hidden&) const = default;

 private:
  friend class polyaffine::ArchiveAccess;
  Hidden() = default;
  template <class Archive>
  void archive(Archive& a) {
    a(name_);
  }
  std::string name_;
};

struct Rounded {
  Matrix values;
};

template <class Archive>
void archive(Archive& a, Rounded& x) {
  a(single(x.values));
}

struct Things {
  int count = 0;
  double number = 0;
  bool yes = false;
  Colour colour = Colour::red;
  std::string text;
  std::vector<double> numbers;
  std::vector<bool> truths;
  std::vector<std::string> texts;
  std::optional<Hidden> hidden, missing;
  std::array<int, 3> triple{};
  std::map<std::string, Vector> fields;
  std::shared_ptr<const Hidden> one, same, none;
  Vec3 point = Vec3::Zero();
  Matrix matrix;
  Points points;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 10, 1> few;
  Eigen::SparseMatrix<double, Eigen::RowMajor> sparse;
};

template <class Archive>
void archive(Archive& a, Things& x) {
  a(x.count, x.number, x.yes, x.colour, x.text, x.numbers, x.truths, x.texts, x.hidden, x.missing, x.triple);
  a.section("eigen", [&] { a(x.fields, x.point, x.matrix, x.points, x.few, x.sparse); });
  a(x.one, x.same, x.none);
}

Things things() {
  Things out;
  out.count = -7;
  out.number = -0.0;
  out.yes = true;
  out.colour = Colour::green;
  out.text = std::string("zero \0 inside", 13);
  out.numbers = {1, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::infinity()};
  out.truths = {true, false, true};
  out.texts = {"a", "", "c"};
  out.hidden = Hidden("deep");
  out.triple = {1, 2, 3};
  out.fields = {{"x", Vector::LinSpaced(4, 0, 1)}, {"empty", Vector()}};
  out.one = out.same = std::make_shared<const Hidden>("shared");
  out.point = {1, 2, 3};
  out.matrix = Matrix::Identity(2, 5) / 3;
  out.points = Points::Constant(3, 2, 0.1);
  out.few.setConstant(4, 9);
  out.sparse.resize(3, 4);
  out.sparse.insert(0, 1) = 1.5;
  out.sparse.insert(2, 3) = -2;
  return out;
}

template <class T>
std::string file_of(const T& value, const ArchiveFormat& format = kFormat) {
  ArchiveWriter out;
  out(value);
  return out.file(format);
}

template <class T>
T back(const T& value) {
  return value_of_archive<T>(file_of(value), kFormat, "memory");
}

std::string refusal(const std::string& file) {
  return error_of([&] { value_of_archive<Things>(file, kFormat, "things.bin"); });
}

/// A file whose checksum and size are those of its changed bytes.
std::string resealed(std::string file) {
  const std::uint64_t size = file.size();
  std::memcpy(file.data() + 8, &size, sizeof size);
  Fnv1a sum;
  sum.add(std::span<const char>(file.data(), file.size() - 8));
  const std::uint64_t value = sum.value();
  std::memcpy(file.data() + file.size() - 8, &value, sizeof value);
  return file;
}

TEST(Archive, GivesEveryTypeBack) {
  const Things from = things();
  const Things to = back(from);
  EXPECT_EQ(to.count, from.count);
  EXPECT_TRUE(std::signbit(to.number));
  EXPECT_TRUE(to.yes);
  EXPECT_EQ(to.colour, from.colour);
  EXPECT_EQ(to.text, from.text);
  EXPECT_EQ(to.numbers, from.numbers);
  EXPECT_EQ(to.truths, from.truths);
  EXPECT_EQ(to.texts, from.texts);
  EXPECT_EQ(to.hidden, from.hidden);
  EXPECT_FALSE(to.missing);
  EXPECT_EQ(to.triple, from.triple);
  EXPECT_EQ(to.fields, from.fields);
  EXPECT_EQ(to.point, from.point);
  EXPECT_EQ(to.matrix, from.matrix);
  EXPECT_EQ(to.points, from.points);
  EXPECT_EQ(to.few, from.few);
  EXPECT_EQ(Matrix(to.sparse), Matrix(from.sparse));
  EXPECT_EQ(to.sparse.nonZeros(), 2);
}

TEST(Archive, StoresOnceWhatSeveralPointTo) {
  const Things to = back(things());
  ASSERT_TRUE(to.one);
  EXPECT_EQ(*to.one, Hidden("shared"));
  EXPECT_EQ(to.one, to.same);
  EXPECT_FALSE(to.none);
}

TEST(Archive, SinglePrecisionTakesHalfTheBytes) {
  const Rounded from{Matrix::Random(20, 30)};
  const Rounded to = back(from);
  EXPECT_EQ(to.values, from.values.cast<float>().cast<double>());
  EXPECT_EQ(file_of(from.values).size() - file_of(from).size(), 20u * 30 * 4);
}

// A file of today must be read tomorrow: magic, size 60, name, version, values, checksum.
TEST(Archive, BytesAreThoseOfTheFormat) {
  const std::string file = file_of(std::pair{std::string("ab"), 1.5}, {"n", 2});
  const std::string expected(
      "\x89PAF\r\n\x1a\n"
      "\x37\0\0\0\0\0\0\0"
      "\1\0\0\0\0\0\0\0n"
      "\2\0\0\0"
      "\2\0\0\0\0\0\0\0"
      "ab"
      "\0\0\0\0\0\0\xf8\x3f",
      47);
  EXPECT_EQ(file.substr(0, file.size() - 8), expected);
  EXPECT_EQ(file, resealed(file));
}

TEST(Archive, EveryDamagedByteIsNoticed) {
  const std::string file = file_of(things());
  for (std::size_t k = 0; k < file.size(); ++k)
    for (const char mask : {'\x01', '\x80', '\xff'}) {
      std::string damaged = file;
      damaged[k] = static_cast<char>(damaged[k] ^ mask);
      ASSERT_THAT(refusal(damaged), HasSubstr("things.bin: found")) << "byte " << k;
    }
}

TEST(Archive, EveryCutIsNoticed) {
  const std::string file = file_of(things());
  for (std::size_t n = 0; n < file.size(); ++n)
    ASSERT_THAT(refusal(file.substr(0, n)), AllOf(HasSubstr("things.bin: found"), HasSubstr("expected")))
        << n;
  EXPECT_THAT(refusal(file + "x"), HasSubstr("cut off or damaged"));
}

TEST(Archive, OtherFilesAreRefusedWithWhatTheyAre) {
  EXPECT_THAT(refusal("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"),
              HasSubstr("another kind of file, expected \"test things\" of version 3"));
  EXPECT_THAT(refusal(file_of(things(), {"test things", 4})), HasSubstr("found version 4, expected"));
  EXPECT_THAT(refusal(file_of(things(), {"other\n", 3})), HasSubstr("found \"other?\", expected"));
  EXPECT_THAT(refusal(resealed(file_of(things()).insert(60, "y"))), HasSubstr("things.bin: found"));
}

TEST(Archive, SectionsAreToldApartAndReadToTheirEnd) {
  const auto read = [](const std::string& name, bool all) {
    ArchiveWriter out;
    out.section("first", [&] { out(1, 2); });
    out(3);
    return error_of([&] {
      ArchiveReader in(out.file(kFormat), kFormat, "memory");
      int a = 0, b = 0, c = 0;
      in.section(name, [&] { all ? in(a, b) : in(a); });
      in(c);
      in.finish();
      EXPECT_EQ(c, 3);
    });
  };
  EXPECT_EQ(read("first", true), "no error");
  EXPECT_THAT(read("second", true), HasSubstr("found the section \"first\", expected \"second\""));
  EXPECT_THAT(read("first", false), HasSubstr("section \"first\": found 4 bytes too many"));
}

// Lengths are compared with the bytes that are left before anything is allocated.
TEST(Archive, AbsurdLengthsAreRefused) {
  const auto claims = [](auto value, std::initializer_list<std::uint64_t> lengths) {
    ArchiveWriter out;
    for (const std::uint64_t length : lengths) out(length);
    out(std::uint64_t{0});
    return error_of([&] { value_of_archive<decltype(value)>(out.file(kFormat), kFormat, "memory"); });
  };
  for (const std::uint64_t n : {std::uint64_t{9}, std::uint64_t{1} << 33, ~std::uint64_t{0}}) {
    EXPECT_THAT(claims(std::string(), {n}), HasSubstr("found the length"));
    EXPECT_THAT(claims(std::vector<double>(), {n}), HasSubstr("found the length"));
    EXPECT_THAT(claims(std::vector<Things>(), {n}), HasSubstr("found the length"));
  }
  EXPECT_THAT(claims(Matrix(), {1u << 30, 1u << 30}), HasSubstr("found a matrix of 1073741824 × 1073741824"));
  EXPECT_THAT(claims(Matrix(), {0, std::uint64_t{1} << 40}), HasSubstr("found the length"));
  using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  EXPECT_THAT(claims(Sparse(), {4, std::uint64_t{1} << 60}), HasSubstr("found the length"));
}

TEST(Archive, SparseMatricesOutOfOrderAreRefused) {
  const auto read = [](std::vector<int> starts, std::vector<int> places) {
    ArchiveWriter out;
    out(std::uint64_t{4}, starts, places, std::vector<double>(places.size(), 1.0));
    return error_of([&] {
      value_of_archive<Eigen::SparseMatrix<double, Eigen::RowMajor>>(out.file(kFormat), kFormat, "memory");
    });
  };
  EXPECT_EQ(read({0, 1, 3}, {3, 0, 2}), "no error");
  EXPECT_EQ(read({0}, {}), "no error");
  for (const auto& starts : std::vector<std::vector<int>>{{}, {0, 1, 4}, {1, 1, 3}, {0, 4, 3}, {0, -1, 3}})
    EXPECT_THAT(read(starts, {3, 0, 2}), HasSubstr("out of place"));
  for (const auto& places : std::vector<std::vector<int>>{{4, 0, 2}, {-1, 0, 2}, {0, 2, 2}, {0, 3, 1}})
    EXPECT_THAT(read({0, 1, 3}, places), HasSubstr("out of place"));
}

// Bytes with a checksum that fits, as a hostile writer makes them: read or refused, nothing else.
TEST(Archive, AnyBytesAreReadOrRefused) {
  const std::string file = file_of(things());
  std::mt19937 random(7);
  int refused = 0;
  for (int k = 0; k < 20000; ++k) {
    std::string changed = file;
    for (unsigned edits = 1 + random() % 4; edits > 0; --edits)
      changed[16 + random() % (changed.size() - 24)] = static_cast<char>(random() % 3 ? random() : 0xff);
    const std::string error = refusal(resealed(changed));
    if (error != "no error") {
      ++refused;
      ASSERT_THAT(error, HasSubstr("things.bin: ")) << "input " << k;
    }
  }
  EXPECT_GT(refused, 5000);
  EXPECT_LT(refused, 19000);
}

TEST(Archive, FilesAreWrittenAndReadByName) {
  const TemporaryFolder folder;
  const auto file = folder.path / "x.bin";
  write_archive(file, kFormat, std::vector<int>{1, 2});
  EXPECT_EQ(read_archive<std::vector<int>>(file, kFormat), (std::vector<int>{1, 2}));
  for (const auto& bad : {folder.path / "none.bin", folder.path})
    EXPECT_THAT(error_of([&] { read_archive<int>(bad, kFormat); }),
                HasSubstr(bad.string() + ": cannot read"));
}

}  // namespace
}  // namespace polyaffine
