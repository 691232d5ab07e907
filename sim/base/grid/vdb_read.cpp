// Reading OpenVDB files.
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <istream>
#include <mutex>
#include <new>

#include "sim/base/error.h"
#include "sim/base/grid/vdb_io.h"
#include "sim/base/grid/vdb_outline.h"
#include "sim/base/quiet_decoder.h"

namespace vegard::sim {
namespace {

using openvdb::FloatGrid;

constexpr float kVdbMaxNumber = 1e30f;  // sums along a ray and a gain stay floats
constexpr double kVdbMaxEdge = 1e9, kVdbMaxPlace = 1e12;
Error too_large(const std::string& path, double bytes, std::uint64_t max_bytes) {
  char text[160];
  std::snprintf(text, sizeof text, "its grids take at least %.3g MB of memory, of which %.3g MB may be used",
                bytes / 1048576.0, static_cast<double>(max_bytes) / 1048576.0);
  return unreadable(path, text).expected("smaller grids, or larger voxels");
}

void take_metadata(const openvdb::MetaMap& from, VdbMetadata& to) {
  for (auto it = from.beginMeta(); it != from.endMeta(); ++it) {
    const openvdb::Metadata& entry = *it->second;
    if (const auto* text = dynamic_cast<const openvdb::StringMetadata*>(&entry))
      to.texts.emplace(it->first, text->value());
    else if (const auto* real = dynamic_cast<const openvdb::DoubleMetadata*>(&entry))
      to.numbers.emplace(it->first, real->value());
    else if (const auto* narrow = dynamic_cast<const openvdb::FloatMetadata*>(&entry))
      to.numbers.emplace(it->first, narrow->value());
  }
}

/// Refuses before the first byte what reaches behind the file's end. The library takes a length from the file
/// for how much to read, into room of a size that it knows.
class BoundedFile : public std::filebuf {
 public:
  explicit BoundedFile(const std::string& path) {
    if (open(path, std::ios::in | std::ios::binary) != nullptr) size_ = pubseekoff(0, std::ios::end);
    pubseekpos(0);
  }

 protected:
  std::streamsize xsgetn(char* to, std::streamsize count) override {
    constexpr std::streamsize kLeaf = 4096;  // what is smaller ends in an exception of the stream's at worst
    if (count < 0 || (count > kLeaf && count > size_ - pubseekoff(0, std::ios::cur, std::ios::in)))
      throw std::ios_base::failure("behind the end");
    return std::filebuf::xsgetn(to, count);
  }

 private:
  std::streamoff size_ = 0;
};

/// A file whose grids are read one by one. Unlike the library's own it ends with an exception where the file
/// ends, and not with whatever stood in memory.
class VdbReader : public openvdb::io::Archive {
 public:
  explicit VdbReader(const std::string& path)
      : metadata_(new openvdb::io::StreamMetadata), file_(path), stream_(&file_) {
    stream_.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
    metadata_->setSeekable(true);
    openvdb::io::setStreamMetadataPtr(stream_, metadata_, false);
    readHeader(stream_);
    setFormatVersion(stream_);
    setLibraryVersion(stream_);
    setDataCompression(stream_);
    of_file_.readMeta(stream_);
    const std::int32_t count = readGridCount(stream_);
    for (std::int32_t i = 0; i < count; ++i) {
      Place place;
      place.is_float = place.at.read(stream_)->isType<FloatGrid>();
      place.at.seekToEnd(stream_);
      places_.push_back(place);
    }
  }

  const openvdb::MetaMap& metadata() const { return of_file_; }

  /// Returns the names of all grids, or of those of floats.
  std::vector<std::string> names(bool only_floats) const {
    std::vector<std::string> all;
    for (const Place& place : places_)
      if (place.is_float || !only_floats) all.push_back(place.at.gridName());
    std::sort(all.begin(), all.end());
    return all;
  }

  FloatGrid::Ptr grid(const std::string& name) {
    for (const Place& place : places_)
      if (place.is_float && place.at.gridName() == name) return read(place.at);
    return nullptr;
  }

 private:
  struct Place {
    openvdb::io::GridDescriptor at;
    bool is_float = false;
  };

  FloatGrid::Ptr read(const openvdb::io::GridDescriptor& at) {
    openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(FloatGrid::gridType());  // as in vdb_io.cpp
    grid->setName(at.gridName());
    grid->setSaveFloatAsHalf(at.saveFloatAsHalf());
    at.seekToGrid(stream_);
    readGrid(grid, at, stream_);
    if (at.isInstance()) {
      for (const Place& parent : places_)
        if (parent.is_float && !parent.at.isInstance() && parent.at.uniqueName() == at.instanceParentName())
          connectInstance(at, {{at.uniqueName(), grid}, {parent.at.uniqueName(), read(parent.at)}});
    }
    return openvdb::gridPtrCast<FloatGrid>(grid);
  }

  openvdb::io::StreamMetadata::Ptr metadata_;
  BoundedFile file_;
  std::istream stream_;
  openvdb::MetaMap of_file_;
  std::vector<Place> places_;
};

/// Index (i, j, k) to the world, or an Error.
void take_place(const std::string& path, const FloatGrid& from, double centre_index, SparseGrid& to) {
  const std::string expected = "a shift, a turn and one scale for all axes";
  if (!from.transform().isLinear())
    throw unreadable(path, "the grid '" + from.getName() + "' is not placed by a linear transform")
        .expected(expected);
  const openvdb::math::Mat4d m = from.transform().baseMap()->getAffineMap()->getMat4();
  double length[3];
  for (int a = 0; a < 3; ++a)
    length[a] = std::sqrt(m(a, 0) * m(a, 0) + m(a, 1) * m(a, 1) + m(a, 2) * m(a, 2));
  to.voxel = length[0];
  bool good = length[0] > 0.0;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const double across = m(a, 0) * m(b, 0) + m(a, 1) * m(b, 1) + m(a, 2) * m(b, 2);
    good = good && std::abs(length[a] / length[0] - 1.0) < 1e-6 &&
           std::abs(across) < 1e-6 * length[0] * length[0];
  }
  if (!good)
    throw unreadable(path, "the grid '" + from.getName() + "' has voxels that are no cubes")
        .expected(expected)
        .hint("Resample it onto cubes");
  if (!(to.voxel >= 1.0 / kVdbMaxEdge && to.voxel <= kVdbMaxEdge))
    throw unreadable(path, "the edge of its voxels is out of range").expected("1e-9 to 1e9");
  for (int c = 0; c < 3; ++c) {
    to.origin[c] = m(3, c);
    for (int a = 0; a < 3; ++a) {
      to.axes[a][c] = m(a, c) / to.voxel;
      to.origin[c] += (centre_index - 0.5) * m(a, c);
    }
    if (!(std::abs(to.origin[c]) <= kVdbMaxPlace))
      throw unreadable(path, "a grid's place is no number, or out of range")
          .expected("at most 1e12 from the origin");
  }
}

bool same_place(const SparseGrid& a, const SparseGrid& b) {
  bool same = std::abs(a.voxel - b.voxel) <= 1e-6 * a.voxel;
  for (int c = 0; c < 3; ++c) {
    same = same && std::abs(a.origin[c] - b.origin[c]) <= 1e-4 * a.voxel;
    for (int i = 0; i < 3; ++i) same = same && std::abs(a.axes[i][c] - b.axes[i][c]) <= 1e-6;
  }
  return same;
}

/// Puts a grid's voxels into bricks, tiles of one number among them, which OpenVDB keeps as such.
class BrickFilling {
 public:
  BrickFilling(const std::string& path, std::uint64_t max_bytes, std::uint64_t bytes_beside, SparseGrid& to)
      : path_(path),
        max_bytes_(max_bytes),
        bytes_of_brick_(to.channels.size() * SparseGrid::kVoxels * sizeof(float) + bytes_beside),
        max_bricks_(max_bytes / bytes_of_brick_),
        to_(to) {}

  void take(const FloatGrid& from, std::size_t channel) {
    for (auto leaf = from.tree().cbeginLeaf(); leaf; ++leaf) {
      float* brick = nullptr;
      for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel) {
        const float number = checked(*voxel, channel);
        if (number == 0.0f) continue;
        if (brick == nullptr) brick = numbers(leaf->origin(), channel);
        brick[voxel.pos()] = number;
      }
    }
    auto tile = from.cbeginValueOn();
    tile.setMaxDepth(FloatGrid::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
      const float number = checked(*tile, channel);
      if (number == 0.0f) continue;
      const openvdb::CoordBBox box = tile.getBoundingBox();
      for (std::int64_t i = box.min().x(); i <= box.max().x(); i += 8)
        for (std::int64_t j = box.min().y(); j <= box.max().y(); j += 8)
          for (std::int64_t k = box.min().z(); k <= box.max().z(); k += 8)
            std::fill_n(numbers(openvdb::Coord(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)),
                                channel),
                        SparseGrid::kVoxels, number);
    }
  }

 private:
  float checked(float number, std::size_t channel) const {
    if (!(std::abs(number) <= kVdbMaxNumber))
      throw unreadable(path_, "the grid '" + to_.channels[channel].name +
                                  "' holds numbers that are not finite or above 1e30")
          .expected("finite numbers below 1e30");
    return number;
  }

  float* numbers(const openvdb::Coord& corner, std::size_t channel) {
    SparseGrid::Brick& brick = to_.brick({corner.x() >> 3, corner.y() >> 3, corner.z() >> 3});
    if (to_.bricks.size() > max_bricks_)
      throw too_large(path_, static_cast<double>(to_.bricks.size()) * bytes_of_brick_, max_bytes_);
    return brick.data() + channel * SparseGrid::kVoxels;
  }

  const std::string& path_;
  std::uint64_t max_bytes_, bytes_of_brick_, max_bricks_;
  SparseGrid& to_;
};

/// Bricks of a grid if all of its leaves hold something.
double bricks_of(const FloatGrid& grid) {
  double bricks = static_cast<double>(grid.tree().leafCount());
  auto tile = grid.cbeginValueOn();
  tile.setMaxDepth(FloatGrid::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) bricks += static_cast<double>(tile.getVoxelCount()) / SparseGrid::kVoxels;
  return bricks;
}

VdbFile read_from(VdbReader& file, const std::string& path, const std::vector<std::string>& wanted,
                  std::uint64_t max_bytes, std::uint64_t bytes_beside) {
  VdbFile out;
  take_metadata(file.metadata(), out.metadata);
  out.names = file.names(true);
  const std::vector<std::string> all = file.names(false);
  std::vector<FloatGrid::Ptr> grids;
  double in_trees = 0.0, max_bricks = 0.0;
  const auto room = [&] {
    const double in_bricks =
        max_bricks * static_cast<double>(grids.size() * SparseGrid::kVoxels * sizeof(float) + bytes_beside);
    if (in_trees + in_bricks > static_cast<double>(max_bytes))
      throw too_large(path, in_trees + in_bricks, max_bytes);
  };
  for (const std::string& name : wanted) {
    if (std::find(out.names.begin(), out.names.end(), name) == out.names.end()) continue;
    if (std::count(all.begin(), all.end(), name) > 1)
      throw unreadable(path, "it has several grids called '" + name + "'").expected("one grid of a name");
    const FloatGrid::Ptr grid = file.grid(name);
    if (grid->getGridClass() == openvdb::GRID_LEVEL_SET)
      throw unreadable(path, "the grid '" + name + "' is a level set").expected("a fog volume");
    take_metadata(*grid, out.metadata);
    const auto centre = out.metadata.numbers.find(kVoxelCentreIndex);
    const double centre_index = centre == out.metadata.numbers.end() ? 0.0 : centre->second;
    if (!(centre_index >= 0.0 && centre_index <= 1.0))
      throw unreadable(path, std::string("its metadata ") + kVoxelCentreIndex + " is out of range")
          .expected("0 to 1");
    SparseGrid place;
    take_place(path, *grid, centre_index, place);
    if (grids.empty()) {
      out.grid = place;
    } else if (!same_place(out.grid, place)) {
      throw unreadable(
          path, "the grids '" + out.grid.channels[0].name + "' and '" + name + "' have different transforms")
          .expected("grids with one transform");
    }
    const auto unit = grid->getMetadata<openvdb::StringMetadata>("unit");
    out.grid.channels.push_back({name, unit ? unit->value() : ""});
    grids.push_back(grid);
    in_trees += static_cast<double>(grid->memUsage());
    max_bricks = std::max(max_bricks, bricks_of(*grid));
    room();
  }
  if (grids.empty()) return out;
  BrickFilling filling(path, max_bytes, bytes_beside, out.grid);
  for (std::size_t c = 0; c < grids.size(); ++c) {
    filling.take(*grids[c], c);
    grids[c].reset();
  }
  return out;
}

}  // namespace

VdbFile read_vdb(const std::string& path, const std::vector<std::string>& wanted, std::uint64_t max_bytes,
                 std::uint64_t bytes_beside) {
  const std::string expected = "a whole OpenVDB file of format 222 or later";
  const auto refused = [&](std::string why) {
    why = why.substr(0, why.find('\n'));
    return unreadable(path, "cannot be read as OpenVDB: " + why).expected(expected);
  };
  const VdbOutline outline = vdb_outline(path, wanted);
  if (!outline.complaint.empty()) throw refused(outline.complaint);
  if (outline.tree_bytes > static_cast<double>(max_bytes))
    throw too_large(path, outline.tree_bytes, max_bytes);
  const QuietDecoder quiet;
  start_vdb_library();
  try {
    VdbReader file(path);
    return read_from(file, path, wanted, max_bytes, bytes_beside);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw refused("there is not enough memory for what it says it holds: it is damaged or too large");
  } catch (const std::ios_base::failure&) {
    throw refused("it is damaged, or ends too early");
  } catch (const std::exception& error) {
    throw refused(error.what());
  }
}

}  // namespace vegard::sim
