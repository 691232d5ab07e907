#include "sim/base/vdb_io.h"

#include <openvdb/openvdb.h>

#include <cerrno>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <mutex>
#include <sstream>

#include "sim/base/error.h"
#include "sim/base/output_error.h"
#include "sim/base/sha256.h"
#include "sim/base/whole_file.h"

namespace vegard::sim {
namespace {

using openvdb::FloatGrid;
using openvdb::Vec3SGrid;
using FloatLeaf = FloatGrid::TreeType::LeafNodeType;
using ColourLeaf = Vec3SGrid::TreeType::LeafNodeType;
static_assert(FloatLeaf::DIM == SparseGrid::kEdge, "a brick is a leaf");

void start_library() {
  static std::once_flag once;
  std::call_once(once, [] { openvdb::initialize(); });
}

Error unreadable(const std::string& path, const std::string& problem, const std::string& expected = {},
                 const std::string& hint = {}) {
  return Error(ErrorKind::unreadable_input, {problem, path, 0, "", expected, hint});
}

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

/// The library names every file anew at random: here by what is in it instead.
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
  start_library();
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
    of_channel.push_back(FloatGrid::create(0.0f));
    add(of_channel.back(), channel.name, channel.unit);
  }
  Vec3SGrid::Ptr colour;
  if (!options.colour_of_channel.empty()) {
    colour = Vec3SGrid::create(openvdb::Vec3s(0.0f));
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

namespace {

/// Index (i, j, k) to the world, or an Error.
void take_place(const std::string& path, const FloatGrid& from, double centre_index, SparseGrid& to) {
  const std::string expected = "a shift, a turn and one scale for all axes";
  if (!from.transform().isLinear())
    throw unreadable(path, "the grid '" + from.getName() + "' is not placed by a linear transform", expected);
  const openvdb::math::Mat4d m = from.transform().baseMap()->getAffineMap()->getMat4();
  double length[3];
  for (int a = 0; a < 3; ++a)
    length[a] = std::sqrt(m(a, 0) * m(a, 0) + m(a, 1) * m(a, 1) + m(a, 2) * m(a, 2));
  to.voxel = length[0];
  bool good = std::isfinite(length[0]) && length[0] > 0.0;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const double across = m(a, 0) * m(b, 0) + m(a, 1) * m(b, 1) + m(a, 2) * m(b, 2);
    good = good && std::abs(length[a] / length[0] - 1.0) < 1e-6 &&
           std::abs(across) < 1e-6 * length[0] * length[0];
  }
  if (!good)
    throw unreadable(path, "the grid '" + from.getName() + "' has voxels that are no cubes", expected,
                     "Resample it onto cubes");
  for (int c = 0; c < 3; ++c) {
    to.origin[c] = m(3, c);
    for (int a = 0; a < 3; ++a) {
      to.axes[a][c] = m(a, c) / to.voxel;
      to.origin[c] += (centre_index - 0.5) * m(a, c);
    }
    if (!std::isfinite(to.origin[c])) throw unreadable(path, "a grid's place is no number", expected);
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

void take_bricks(FloatGrid& from, std::size_t channel, SparseGrid& to) {
  from.tree().voxelizeActiveTiles(false);
  for (auto leaf = from.tree().cbeginLeaf(); leaf; ++leaf) {
    const openvdb::Coord corner = leaf->origin();
    float* brick = nullptr;
    for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel) {
      const float number = *voxel;
      if (number == 0.0f || !std::isfinite(number)) continue;
      if (brick == nullptr)
        brick = to.brick({corner.x() >> 3, corner.y() >> 3, corner.z() >> 3}).data() +
                channel * SparseGrid::kVoxels;
      brick[voxel.pos()] = number;
    }
  }
}

VdbFile read_from(openvdb::io::File& file, const std::string& path, const std::vector<std::string>& wanted,
                  std::uint64_t most_bytes) {
  VdbFile out;
  file.open(false);
  take_metadata(*file.getMetadata(), out.metadata);
  const openvdb::GridPtrVecPtr heads = file.readAllGridMetadata();
  for (const auto& head : *heads)
    if (head->isType<FloatGrid>()) out.names.push_back(head->getName());
  std::vector<FloatGrid::Ptr> grids;
  std::uint64_t bytes = 0;
  for (const std::string& name : wanted) {
    if (std::find(out.names.begin(), out.names.end(), name) == out.names.end()) continue;
    const auto grid = openvdb::gridPtrCast<FloatGrid>(file.readGrid(name));
    if (grid->getGridClass() == openvdb::GRID_LEVEL_SET)
      throw unreadable(path, "the grid '" + name + "' is a level set", "a fog volume");
    const std::uint64_t most_voxels = most_bytes / sizeof(float);
    const std::uint64_t active = grid->activeVoxelCount();
    bytes += active > most_voxels ? most_bytes + 1 : grid->memUsage() + active * sizeof(float);
    if (bytes > most_bytes)
      throw unreadable(path, "its grids take more than " + std::to_string(most_bytes >> 20) + " MB of memory",
                       "smaller grids, or larger voxels");
    take_metadata(*grid, out.metadata);
    const auto centre = out.metadata.numbers.find(kVoxelCentreIndex);
    SparseGrid place;
    take_place(path, *grid, centre == out.metadata.numbers.end() ? 0.0 : centre->second, place);
    if (grids.empty()) {
      out.grid = place;
    } else if (!same_place(out.grid, place)) {
      throw unreadable(path,
                       "the grids '" + out.grid.channels[0].name + "' and '" + name + "' stand differently",
                       "grids with one transform");
    }
    const auto unit = grid->getMetadata<openvdb::StringMetadata>("unit");
    out.grid.channels.push_back({name, unit ? unit->value() : ""});
    grids.push_back(grid);
  }
  for (std::size_t c = 0; c < grids.size(); ++c) {
    take_bricks(*grids[c], c, out.grid);
    grids[c].reset();
  }
  return out;
}

}  // namespace

VdbFile read_vdb(const std::string& path, const std::vector<std::string>& wanted, std::uint64_t most_bytes) {
  start_library();
  try {
    openvdb::io::File file(path);
    return read_from(file, path, wanted, most_bytes);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    std::string why = error.what();
    why = why.substr(0, why.find('\n'));
    throw unreadable(path, "cannot be read as OpenVDB: " + why);
  }
}

std::string vdb_library_version() { return openvdb::getLibraryVersionString(); }

}  // namespace vegard::sim
