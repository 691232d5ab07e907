#include <openvdb/openvdb.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <exception>
#include <fstream>
#include <istream>
#include <new>
#include <utility>

#include "sim/base/grid/openvdb.h"
#include "sim/base/module.h"

namespace vegard::sim {
namespace {

using openvdb::FloatGrid;
using openvdb::Vec3SGrid;
using FloatLeaf = FloatGrid::TreeType::LeafNodeType;
using ColourLeaf = Vec3SGrid::TreeType::LeafNodeType;
static_assert(FloatLeaf::DIM == SparseGrid::kEdge, "a brick is a leaf");

/// The library's way of writing to a stream that can be sought, which it keeps from others than its files:
/// theirs does not notice a full disk.
class Archive : public openvdb::io::Archive {
 public:
  Archive() {
    setCompression(hasBloscCompression() ? openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK
                                         : openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
  }
  void put(std::ostream& to, const openvdb::GridPtrVec& grids, const openvdb::MetaMap& metadata) const {
    openvdb::io::Archive::write(to, grids, true, metadata);
  }
};

void put_metadata(openvdb::MetaMap& to, const VdbMetadata& from) {
  for (const auto& [name, text] : from.texts) to.insertMeta(name, openvdb::StringMetadata(text));
  for (const auto& [name, number] : from.numbers) to.insertMeta(name, openvdb::DoubleMetadata(number));
}

openvdb::math::Transform::Ptr transform_of(const SparseGrid& grid, double centre_index) {
  openvdb::math::Mat4d m = openvdb::math::Mat4d::identity();  // of row vectors
  for (int a = 0; a < 3; ++a)
    for (int c = 0; c < 3; ++c) m(a, c) = grid.voxel * grid.axes[a][c];
  for (int c = 0; c < 3; ++c) {
    m(3, c) = grid.origin[c];
    for (int a = 0; a < 3; ++a) m(3, c) += (0.5 - centre_index) * grid.voxel * grid.axes[a][c];
  }
  return openvdb::math::Transform::createLinearTransform(m);
}

constexpr float kVdbMaxNumber = 1e30f;  // sums along a ray and a gain stay floats
constexpr double kVdbMaxEdge = 1e9, kVdbMaxPlace = 1e12;
/// What ends reading.
class Refusal : public std::exception {
 public:
  explicit Refusal(VdbProblem problem) : problem_(std::move(problem)) {}
  const VdbProblem& problem() const { return problem_; }

 private:
  VdbProblem problem_;
};

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
    openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(FloatGrid::gridType());
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

/// Index (i, j, k) to the world, or a Refusal.
void take_place(const FloatGrid& from, double centre_index, SparseGrid& to) {
  const std::string expected = "a shift, a turn and one scale for all axes";
  if (!from.transform().isLinear())
    throw Refusal({"the grid '" + from.getName() + "' is not placed by a linear transform", expected});
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
    throw Refusal({"the grid '" + from.getName() + "' has voxels that are no cubes", expected,
                   "Resample it onto cubes"});
  if (!(to.voxel >= 1.0 / kVdbMaxEdge && to.voxel <= kVdbMaxEdge))
    throw Refusal({"the edge of its voxels is out of range", "1e-9 to 1e9"});
  for (int c = 0; c < 3; ++c) {
    to.origin[c] = m(3, c);
    for (int a = 0; a < 3; ++a) {
      to.axes[a][c] = m(a, c) / to.voxel;
      to.origin[c] += (centre_index - 0.5) * m(a, c);
    }
    if (!(std::abs(to.origin[c]) <= kVdbMaxPlace))
      throw Refusal({"a grid's place is no number, or out of range", "at most 1e12 from the origin"});
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
  BrickFilling(std::uint64_t max_bytes, std::uint64_t bytes_beside, SparseGrid& to)
      : max_bytes_(max_bytes),
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
      throw Refusal(
          {"the grid '" + to_.channels[channel].name + "' holds numbers that are not finite or above 1e30",
           "finite numbers below 1e30"});
    return number;
  }

  float* numbers(const openvdb::Coord& corner, std::size_t channel) {
    SparseGrid::Brick& brick = to_.brick({corner.x() >> 3, corner.y() >> 3, corner.z() >> 3});
    if (to_.bricks.size() > max_bricks_)
      throw Refusal(too_large_grids(static_cast<double>(to_.bricks.size()) * bytes_of_brick_, max_bytes_));
    return brick.data() + channel * SparseGrid::kVoxels;
  }

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

VdbFile read_from(VdbReader& file, const std::vector<std::string>& wanted, std::uint64_t max_bytes,
                  std::uint64_t bytes_beside) {
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
      throw Refusal(too_large_grids(in_trees + in_bricks, max_bytes));
  };
  for (const std::string& name : wanted) {
    if (std::find(out.names.begin(), out.names.end(), name) == out.names.end()) continue;
    if (std::count(all.begin(), all.end(), name) > 1)
      throw Refusal({"it has several grids called '" + name + "'", "one grid of a name"});
    const FloatGrid::Ptr grid = file.grid(name);
    if (grid->getGridClass() == openvdb::GRID_LEVEL_SET)
      throw Refusal({"the grid '" + name + "' is a level set", "a fog volume"});
    take_metadata(*grid, out.metadata);
    const auto centre = out.metadata.numbers.find(kVoxelCentreIndex);
    const double centre_index = centre == out.metadata.numbers.end() ? 0.0 : centre->second;
    if (!(centre_index >= 0.0 && centre_index <= 1.0))
      throw Refusal({std::string("its metadata ") + kVoxelCentreIndex + " is out of range", "0 to 1"});
    SparseGrid place;
    take_place(*grid, centre_index, place);
    if (grids.empty()) {
      out.grid = place;
    } else if (!same_place(out.grid, place)) {
      throw Refusal(
          {"the grids '" + out.grid.channels[0].name + "' and '" + name + "' have different transforms",
           "grids with one transform"});
    }
    const auto unit = grid->getMetadata<openvdb::StringMetadata>("unit");
    out.grid.channels.push_back({name, unit ? unit->value() : ""});
    grids.push_back(grid);
    in_trees += static_cast<double>(grid->memUsage());
    max_bricks = std::max(max_bricks, bricks_of(*grid));
    room();
  }
  if (grids.empty()) return out;
  BrickFilling filling(max_bytes, bytes_beside, out.grid);
  for (std::size_t c = 0; c < grids.size(); ++c) {
    filling.take(*grids[c], c);
    grids[c].reset();
  }
  return out;
}

/// Creates a grid by the library's registry of grid types: made here, all functions of trees would be
/// compiled here.
template <class Grid>
typename Grid::Ptr new_grid() {
  return openvdb::gridPtrCast<Grid>(openvdb::GridBase::createGrid(Grid::gridType()));
}

openvdb::Coord corner_of(const BrickCoordinate& at) { return openvdb::Coord(at.x * 8, at.y * 8, at.z * 8); }

void add_leaf(const float* numbers, const openvdb::Coord& corner, FloatGrid& to) {
  FloatLeaf* leaf = nullptr;
  for (int v = 0; v < SparseGrid::kVoxels; ++v) {
    if (numbers[v] == 0.0f) continue;
    if (leaf == nullptr) leaf = new FloatLeaf(corner, 0.0f, false);
    leaf->setValueOn(v, numbers[v]);
  }
  if (leaf != nullptr) to.tree().addLeaf(leaf);
}

void add_colours(const SparseGrid::Brick& brick, const std::vector<std::array<float, 3>>& of_channel,
                 const openvdb::Coord& corner, Vec3SGrid& to) {
  ColourLeaf* leaf = nullptr;
  for (int v = 0; v < SparseGrid::kVoxels; ++v) {
    openvdb::Vec3s sum(0.0f);
    for (std::size_t c = 0; c < of_channel.size(); ++c)
      for (int i = 0; i < 3; ++i) sum[i] += of_channel[c][i] * brick[c * SparseGrid::kVoxels + v];
    for (int i = 0; i < 3; ++i) sum[i] = std::max(sum[i], 0.0f);
    if (sum == openvdb::Vec3s(0.0f)) continue;
    if (leaf == nullptr) leaf = new ColourLeaf(corner, openvdb::Vec3s(0.0f), false);
    leaf->setValueOn(v, sum);
  }
  if (leaf != nullptr) to.tree().addLeaf(leaf);
}

bool write(const std::string& path, SparseGrid&& grid, const VdbMetadata& metadata,
           const VdbOptions& options) {
  const auto transform = transform_of(grid, options.centre_index);
  std::vector<FloatGrid::Ptr> of_channel;
  openvdb::GridPtrVec all;
  const auto add = [&](const auto& one, const std::string& name, const std::string& unit) {
    one->setName(name);
    one->setTransform(transform->copy());
    one->setGridClass(openvdb::GRID_FOG_VOLUME);
    for (const auto& [key, number] : metadata.numbers) one->insertMeta(key, openvdb::DoubleMetadata(number));
    one->insertMeta("unit", openvdb::StringMetadata(unit));
    one->insertMeta(kVoxelCentreIndex, openvdb::DoubleMetadata(options.centre_index));
    all.push_back(one);
  };
  for (const GridChannel& channel : grid.channels) {
    of_channel.push_back(new_grid<FloatGrid>());
    add(of_channel.back(), channel.name, channel.unit);
  }
  Vec3SGrid::Ptr colour;
  if (!options.colour_of_channel.empty()) {
    colour = new_grid<Vec3SGrid>();
    colour->setVectorType(openvdb::VEC_INVARIANT);
    add(colour, "color", options.colour_unit);
  }
  while (!grid.bricks.empty()) {
    const auto node = grid.bricks.extract(grid.bricks.begin());
    const openvdb::Coord corner = corner_of(node.key());
    for (std::size_t c = 0; c < of_channel.size(); ++c)
      add_leaf(node.mapped().data() + c * SparseGrid::kVoxels, corner, *of_channel[c]);
    if (colour) add_colours(node.mapped(), options.colour_of_channel, corner, *colour);
  }
  openvdb::MetaMap of_file;
  put_metadata(of_file, metadata);
  of_file.insertMeta(kVoxelCentreIndex, openvdb::DoubleMetadata(options.centre_index));
  try {
    errno = 0;
    std::ofstream stream;
    stream.exceptions(std::ios::failbit | std::ios::badbit);
    stream.open(path, std::ios::binary);
    Archive().put(stream, all, of_file);
    stream.close();
  } catch (const std::exception&) {  // the stream's, or the library's for a stream that has failed
    return false;
  }
  return true;
}

VdbFile read(const std::string& path, const std::vector<std::string>& wanted, std::uint64_t max_bytes,
             std::uint64_t bytes_beside, VdbProblem& problem) {
  try {
    VdbReader file(path);
    return read_from(file, wanted, max_bytes, bytes_beside);
  } catch (const Refusal& refusal) {
    problem = refusal.problem();
  } catch (const std::bad_alloc&) {
    problem = not_openvdb("there is not enough memory for what it says it holds: it is damaged or too large");
  } catch (const std::ios_base::failure&) {
    problem = not_openvdb("it is damaged, or ends too early");
  } catch (const std::exception& error) {
    problem = not_openvdb(error.what());
  }
  return {};
}

/// Called once, before any other use of the library.
const OpenVdb* table() {
  openvdb::initialize();
  static const OpenVdb functions{write, read};
  return &functions;
}

}  // namespace
}  // namespace vegard::sim

VEGARD_MODULE(vegard::sim::table());
