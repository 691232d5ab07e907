#include "sim/base/grid/vdb_io.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iomanip>
#include <mutex>
#include <sstream>

#include "sim/base/error.h"
#include "sim/base/file/sha256.h"
#include "sim/base/file/whole_file.h"

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

/// The library names every file again at random: here by what is in it instead.
void name_by_content(const std::string& path) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  constexpr std::streamoff kPlace = 21, kLength = 36;  // behind magic number, three versions and a flag
  file.exceptions(std::ios::failbit | std::ios::badbit);
  std::string name(kLength, '0');
  file.seekp(kPlace);
  file.write(name.data(), kLength);
  file.seekg(0);
  std::string sums;
  std::vector<char> block(std::size_t{1} << 24);
  file.exceptions(std::ios::badbit);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    sums += sha256({block.data(), static_cast<std::size_t>(file.gcount())});
  const std::string sum = sha256(sums);
  for (std::size_t i = 0, from = 0; i < name.size(); ++i)
    name[i] = i == 8 || i == 13 || i == 18 || i == 23 ? '-' : sum[from++];
  name[14] = '8';  // a UUID of the user's own making (RFC 9562)
  name[19] = 'a';
  file.clear();
  file.exceptions(std::ios::failbit | std::ios::badbit);
  file.seekp(kPlace);
  file.write(name.data(), kLength);
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

}  // namespace

void write_vdb(const std::string& path, SparseGrid&& grid, const VdbMetadata& metadata,
               const VdbOptions& options) {
  start_vdb_library();
  WholeFile file(path, options.overwrite);
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
    stream.open(file.temporary(), std::ios::binary);
    Archive().put(stream, all, of_file);
    stream.close();
    name_by_content(file.temporary());
  } catch (const std::exception&) {  // the stream's, or the library's for a stream that has failed
    throw unwritable(path, errno);
  }
  file.commit();
}

std::string vdb_library_version() { return openvdb::getLibraryVersionString(); }

void start_vdb_library() {
  static std::once_flag once;
  std::call_once(once, [] { openvdb::initialize(); });
}

}  // namespace vegard::sim
