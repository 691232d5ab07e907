// Writing a volumegrid's text.
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <utility>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/grid/grid_planes.h"
#include "sim/base/grid/volumegrid_text.h"

namespace vegard::sim {
namespace {

constexpr double kMaxNumbers = 8589934592.0;  // 2^33, some 20 GB of text
constexpr int kInALine = 20;

/// Text on its way into a file.
class Writer {
 public:
  Writer(const std::string& target, const std::string& path)
      : target_(target), file_(std::fopen(path.c_str(), "wb")) {
    if (file_ == nullptr) throw unwritable(target_, errno);
    text_.reserve(kPiece + 64);
  }
  ~Writer() {
    if (file_ != nullptr) std::fclose(file_);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void add(const char* words) { text_ += words; }
  template <class Number>
  void add_number(Number number) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
    text_.append(digits, end);
    if (text_.size() >= kPiece) flush();
  }
  void finish() {
    flush();
    const bool good = std::fflush(file_) == 0;
    const int error = errno;
    if (std::fclose(std::exchange(file_, nullptr)) != 0 || !good) throw unwritable(target_, error);
  }

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 20;

  void flush() {
    if (std::fwrite(text_.data(), 1, text_.size(), file_) != text_.size()) throw unwritable(target_, errno);
    text_.clear();
  }

  std::string target_, text_;
  std::FILE* file_;
};

/// About what is not 0, and about what was asked for.
VoxelBox box_of(const SparseGrid& grid, int channel, const std::array<int, 3>& size) {
  VoxelBox box = lit_box(grid, channel).value_or(VoxelBox{{0, 0, 0}, {0, 0, 0}});
  if (size[0] > 0 && size[1] > 0 && size[2] > 0)
    for (int a = 0; a < 3; ++a) {
      box.low[a] = std::min(box.low[a], 0);
      box.high[a] = std::max(box.high[a], size[a]);
    }
  return box;
}

void put_triple(Writer& out, const char* before, const std::array<double, 3>& numbers) {
  out.add(before);
  for (int a = 0; a < 3; ++a) {
    out.add(a == 0 ? " [" : " ");
    out.add_number(numbers[a]);
  }
  out.add("]");
}

}  // namespace

void write_volumegrid(const std::string& path, const SparseGrid& grid, int channel,
                      const VolumegridOptions& options) {
  const auto unfit = [&](const std::string& problem) {
    return Error(ErrorKind::unwritable_output, problem).file(path);
  };
  for (int a = 0; a < 3; ++a)
    for (int c = 0; c < 3; ++c)
      if (grid.axes[a][c] != (a == c ? 1.0 : 0.0))
        throw unfit("the grid is turned, and a volumegrid is not")
            .expected("voxels along x, y and z")
            .hint("-o OUT.vdb");
  const VoxelBox box = box_of(grid, channel, options.size);
  if (box.low[0] >= box.high[0]) throw unfit("nothing in the grid is above or below 0").expected("a density");
  double count = 1.0;
  std::array<double, 3> p0, p1;
  int size[3];
  for (int a = 0; a < 3; ++a) {
    size[a] = box.high[a] - box.low[a];
    count *= size[a];
    p0[a] = grid.origin[a] + grid.voxel * box.low[a];
    p1[a] = grid.origin[a] + grid.voxel * box.high[a];
  }
  if (count > kMaxNumbers)
    throw unfit("a volumegrid would have " + std::to_string(size[0]) + " x " + std::to_string(size[1]) +
                " x " + std::to_string(size[2]) + " numbers, the empty ones as well")
        .expected("at most 2^33")
        .hint("-o OUT.vdb, which leaves out what is empty");

  WholeFile file(path, options.overwrite);
  Writer out(path, file.temporary());
  out.add("Volume \"volumegrid\"");
  constexpr const char* kName[3] = {" \"integer nx\" [", " \"integer ny\" [", " \"integer nz\" ["};
  for (int a = 0; a < 3; ++a) {
    out.add(kName[a]);
    out.add_number(size[a]);
    out.add("]");
  }
  put_triple(out, "\n  \"point p0\"", p0);
  put_triple(out, " \"point p1\"", p1);
  for (const auto& [name, numbers] : options.colours)
    put_triple(out, ("\n  \"color " + name + "\"").c_str(), numbers);
  for (const auto& [name, number] : options.numbers) {
    out.add(("\n  \"float " + name + "\" [").c_str());
    out.add_number(number);
    out.add("]");
  }
  out.add("\n  \"float density\" [\n");
  const int columns = ((box.high[0] - 1) >> 3) - (box.low[0] >> 3) + 1;
  std::vector<const float*> row(columns);  // bricks along x
  for (int z = box.low[2]; z < box.high[2]; ++z)
    for (int y = box.low[1]; y < box.high[1]; ++y) {
      for (int b = 0; b < columns; ++b) {
        const auto found = grid.bricks.find({(box.low[0] >> 3) + b, y >> 3, z >> 3});
        row[b] = found == grid.bricks.end()
                     ? nullptr
                     : found->second.data() + static_cast<std::size_t>(channel) * SparseGrid::kVoxels;
      }
      for (int x = box.low[0]; x < box.high[0]; ++x) {
        const float* brick = row[(x >> 3) - (box.low[0] >> 3)];
        const float number = brick == nullptr ? 0.0f : brick[SparseGrid::within(x & 7, y & 7, z & 7)];
        out.add_number(number == 0.0f ? 0.0f : number);  // without the sign of a negative zero
        out.add((x - box.low[0]) % kInALine == kInALine - 1 || x + 1 == box.high[0] ? "\n" : " ");
      }
    }
  out.add("  ]\n");
  out.finish();
  file.commit();
}

}  // namespace vegard::sim
