#include "sim/base/grid/volumegrid_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/grid/volumegrid_words.h"
#include "sim/base/large_vector.h"
#include "sim/base/text.h"

namespace vegard::sim {
namespace {

constexpr int kMaxSide = 65536;
constexpr double kCubeTolerance = 1e-4;  // the text may have few digits
constexpr float kTextMaxNumber = 1e30f;  // as of OpenVDB files
constexpr double kTextMaxPlace = 1e12, kMinEdge = 1e-9,
                 kTextMaxEdge = 1e9;  // squares of lengths stay numbers
using WordKind = VolumegridWords::Kind;

std::string in_words(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", number);
  return text;
}

/// Takes densities in the order of the file, and puts them into bricks as soon as it knows where they belong.
class DensityFiller {
 public:
  DensityFiller(SparseGrid& grid, std::uint64_t max_bytes) : grid_(grid), max_bytes_(max_bytes) {}

  void know_size(const std::array<int, 3>& size, const VolumegridWords& words) {
    size_ = size;
    expected_ = static_cast<std::uint64_t>(size[0]) * size[1] * size[2];
    columns_ = (size[0] + SparseGrid::kEdge - 1) / SparseGrid::kEdge;
    const std::size_t bricks =
        static_cast<std::size_t>(columns_) * ((size[1] + SparseGrid::kEdge - 1) / SparseGrid::kEdge);
    slab_bytes_ = bricks * sizeof(float*);
    if (slab_bytes_ > max_bytes_) throw too_many_densities(words);
    slab_.assign(bricks, nullptr);
    known_ = true;
    for (const float number : early_) put(number, words);
    LargeVector<float>().swap(early_);
  }

  void add(float number, const VolumegridWords& words) {
    ++count_;
    if (known_) return put(number, words);
    if (early_.size() * sizeof(float) >= max_bytes_) throw too_many_densities(words);
    early_.push_back(number);
  }

  std::uint64_t count() const { return count_; }
  std::uint64_t expected() const { return expected_; }

 private:
  Error too_many_densities(const VolumegridWords& words) const {
    return words
        .error_here("its densities take more than " + in_words(static_cast<double>(max_bytes_) / 1048576.0) +
                    " MB of memory")
        .expected("fewer voxels along x and y, or fewer that are not 0");
  }

  void put(float number, const VolumegridWords& words) {
    if (at_[2] >= size_[2]) throw words.error_here("there are too many densities").expected(expected_words());
    if (number != 0.0f) {
      float*& brick =
          slab_[static_cast<std::size_t>(at_[1] / SparseGrid::kEdge) * columns_ + at_[0] / SparseGrid::kEdge];
      if (brick == nullptr) {
        const std::uint64_t after = (grid_.bricks.size() + 1) * (SparseGrid::kVoxels * sizeof(float));
        if (after + slab_bytes_ > max_bytes_) throw too_many_densities(words);
        brick =
            grid_.brick({at_[0] / SparseGrid::kEdge, at_[1] / SparseGrid::kEdge, at_[2] / SparseGrid::kEdge})
                .data();
      }
      brick[SparseGrid::within(at_[0] % SparseGrid::kEdge, at_[1] % SparseGrid::kEdge,
                               at_[2] % SparseGrid::kEdge)] = number;
    }
    if (++at_[0] < size_[0]) return;
    at_[0] = 0;
    if (++at_[1] < size_[1]) return;
    at_[1] = 0;
    if (++at_[2] % SparseGrid::kEdge == 0) std::fill(slab_.begin(), slab_.end(), nullptr);
  }

 public:
  std::string expected_words() const {
    return std::to_string(expected_) + " of them, nx ny nz = " + std::to_string(size_[0]) + " x " +
           std::to_string(size_[1]) + " x " + std::to_string(size_[2]);
  }

 private:
  SparseGrid& grid_;
  std::uint64_t max_bytes_;
  bool known_ = false;
  std::array<int, 3> size_{0, 0, 0}, at_{0, 0, 0};
  int columns_ = 0;
  std::uint64_t count_ = 0, expected_ = 0;
  std::uint64_t slab_bytes_ = 0;
  std::vector<float*> slab_;  ///< bricks of the present eight layers
  LargeVector<float> early_;  ///< densities before their sizes
};

/// One "volumegrid" and its parameters.
class VolumegridReader {
 public:
  VolumegridReader(const std::string& path, std::uint64_t max_bytes)
      : words_(path), filler_(out_.grid, max_bytes) {
    out_.grid.channels = {{"density", ""}};
  }

  VolumegridFile read() {
    find_volume();
    while (kind_ == WordKind::text) read_parameter();
    finish();
    for (; kind_ != WordKind::end; kind_ = words_.next())
      if (is_volume() && words_.next() == WordKind::text && words_.word() == "volumegrid")
        throw words_.error_here("there is a second volumegrid").expected("one in a file");
    return std::move(out_);
  }

 private:
  bool is_volume() const { return kind_ == WordKind::bare && words_.word() == "Volume"; }

  void find_volume() {
    bool found = false;
    while (!found) {
      kind_ = words_.next();
      if (kind_ == WordKind::end)
        throw words_.error_here("it has no volumegrid")
            .expected("Volume \"volumegrid\" and its parameters")
            .hint("an OpenVDB file's name ends in .vdb");
      if (!is_volume()) continue;
      kind_ = words_.next();
      found = kind_ == WordKind::text && words_.word() == "volumegrid";
    }
    kind_ = words_.next();
  }

  /// Calls use() for each word of the parameter's value, and goes to the word behind it.
  template <class Use>
  void for_each_value(const std::string& name, const Use& use) {
    kind_ = words_.next();
    if (kind_ == WordKind::end)
      throw words_.error_here("the file ends before the value of \"" + name + "\"").expected("a value");
    if (kind_ == WordKind::close)
      throw words_.error_here("a ] without its [").expected("a value of \"" + name + "\"");
    const bool bracketed = kind_ == WordKind::open;
    if (bracketed) kind_ = words_.next();
    while (!bracketed || kind_ != WordKind::close) {
      if (kind_ == WordKind::end) {
        const bool counts = name == "density" && filler_.expected() > 0;
        throw words_
            .error_here("the file is cut off within \"" + name + "\"" +
                        (counts ? ", after " + std::to_string(filler_.count()) + " densities" : ""))
            .expected(counts ? filler_.expected_words() : "a ]");
      }
      if (kind_ == WordKind::open) throw words_.error_here("a [ within a list").expected("numbers, or a ]");
      use();
      if (!bracketed) break;
      kind_ = words_.next();
    }
    kind_ = words_.next();
  }

  double number(const std::string& name) {
    if (kind_ != WordKind::bare)
      throw words_.error_here("\"" + words_.word() + "\" is no number of \"" + name + "\"")
          .expected("a finite number");
    return words_.number();
  }

  void read_parameter() {
    const std::string declared = words_.word();
    const std::size_t blank = declared.find_first_of(" \t");
    const std::size_t behind = declared.find_first_not_of(" \t", blank);
    if (blank == std::string::npos || behind == std::string::npos)
      throw words_.error_here("\"" + declared + "\" is no parameter")
          .expected("a type and a name, such as \"integer nx\"");
    const std::string type = declared.substr(0, blank);
    const std::string name = declared.substr(behind, declared.find_last_not_of(" \t") + 1 - behind);
    const int axis = name == "nx" ? 0 : name == "ny" ? 1 : name == "nz" ? 2 : -1;
    if (axis >= 0) {
      if (size_[axis] > 0)
        throw words_.error_here("\"" + name + "\" is given twice").expected("one number of voxels");
      return read_size(name, axis);
    }
    if (name == "p0" || name == "p1") return read_corner(name);
    if (name == "density") {
      if (filler_.count() > 0) throw words_.error_here("\"density\" is given twice").expected("one list");
      return for_each_value(name, [&] {
        const double value = number(name);
        if (std::abs(value) > static_cast<double>(kTextMaxNumber))
          throw words_.error_here("the density " + words_.word() + " is too large").expected("at most 1e30");
        filler_.add(static_cast<float>(value), words_);
      });
    }
    if (type == "color" || type == "rgb" || type == "spectrum") return read_numbers(name, out_.colours[name]);
    if (type != "float") return for_each_value(name, [] {});
    std::vector<double> values;
    for_each_value(name, [&] {
      if (values.size() < 2 && kind_ == WordKind::bare) values.push_back(words_.number());
    });
    if (values.size() == 1) out_.numbers[name] = values.front();
  }

  void read_size(const std::string& name, int axis) {
    int values = 0;
    for_each_value(name, [&] {
      const double value = number(name);
      if (!(value >= 1.0 && value <= kMaxSide) || value != std::floor(value) || ++values > 1)
        throw words_.error_here("'" + words_.word() + "' is no number of voxels")
            .expected("\"" + name + "\", one whole number from 1 to 65536");
      size_[axis] = static_cast<int>(value);
    });
    if (values == 0)
      throw words_.error_here("\"" + name + "\" has no value").expected("a whole number from 1 to 65536");
    if (!sized_ && size_[0] > 0 && size_[1] > 0 && size_[2] > 0) {
      sized_ = true;
      filler_.know_size(size_, words_);
    }
  }

  void read_numbers(const std::string& name, std::array<double, 3>& to) {
    std::size_t values = 0;
    const int line = words_.line();
    for_each_value(name, [&] {
      const double value = number(name);
      if (values < 3) to[values] = value;
      ++values;
    });
    if (values == 3) return;
    throw words_
        .error_here("\"" + name + "\" of line " + std::to_string(line) + " has " + std::to_string(values) +
                    " numbers")
        .expected("three");
  }

  void read_corner(const std::string& name) {
    const int corner = name == "p0" ? 0 : 1;
    if (corner_line_[corner] > 0)
      throw words_.error_here("\"" + name + "\" is given twice").expected("one point");
    corner_line_[corner] = words_.line();
    read_numbers(name, corner_[corner]);
    for (const double place : corner_[corner])
      if (!(std::abs(place) <= kTextMaxPlace))
        throw words_
            .error_here("\"" + name + "\" of line " + std::to_string(corner_line_[corner]) + " is at " +
                        in_words(place))
            .expected("places from -1e12 to 1e12");
  }

  void finish() {
    constexpr const char* kName[3] = {"nx", "ny", "nz"};
    for (int a = 0; a < 3; ++a)
      if (size_[a] == 0)
        throw words_.error_here(std::string("there is no \"integer ") + kName[a] + "\"")
            .expected("how many voxels there are along each axis");
    if (filler_.count() != filler_.expected())
      throw words_.error_here("there are " + std::to_string(filler_.count()) + " densities")
          .expected(filler_.expected_words());
    double edge[3];
    for (int a = 0; a < 3; ++a) {
      edge[a] = (corner_[1][a] - corner_[0][a]) / size_[a];
      if (!(edge[a] > 0.0))
        throw words_.error_here("p1 is not above p0 along all axes").expected("a box from p0 to p1");
      if (!(edge[a] >= kMinEdge && edge[a] <= kTextMaxEdge))
        throw words_.error_here("its voxels are " + in_words(edge[a]) + " wide")
            .expected("a box of voxels from 1e-9 to 1e9");
    }
    const double mean = (edge[0] + edge[1] + edge[2]) / 3.0;
    for (int a = 0; a < 3; ++a)
      if (std::abs(edge[a] - mean) > kCubeTolerance * mean)
        throw words_
            .error_here("its voxels are no cubes, but " + in_words(edge[0]) + " x " + in_words(edge[1]) +
                        " x " + in_words(edge[2]))
            .expected("p1 - p0 in the proportion of nx, ny and nz")
            .hint("sample it again with cubes; cells along an axis of " +
                  in_words(std::round(size_[0] * edge[0] / edge[2])) + ", " +
                  in_words(std::round(size_[1] * edge[1] / edge[2])) + " and " + in_words(size_[2]) +
                  " would be");
    out_.grid.voxel = mean;
    out_.grid.origin = corner_[0];
    out_.size = size_;
  }

  VolumegridWords words_;
  WordKind kind_ = WordKind::end;
  VolumegridFile out_;
  DensityFiller filler_;
  bool sized_ = false;
  std::array<int, 3> size_{0, 0, 0};
  int corner_line_[2] = {0, 0};  ///< where it is given; or not
  std::array<double, 3> corner_[2] = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
};

}  // namespace

bool is_volumegrid_name(const std::string& path) {
  const std::string extension = lowered_extension(path);
  return extension == ".pbrt" || extension == ".volumegrid" || extension == ".txt";
}

VolumegridFile read_volumegrid(const std::string& path, std::uint64_t max_bytes) {
  return VolumegridReader(path, max_bytes).read();
}

}  // namespace vegard::sim
