#include "sim/base/grid/vdb_outline.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "sim/base/file/input_file.h"
#include "sim/base/text.h"

namespace vegard::sim {
namespace {

constexpr std::int64_t kMagic = 0x56444220;  // " BDV"
// 222 (OpenVDB 2.3 of 2014) is the first that says compression grid by grid; 224 is the newest.
constexpr std::uint32_t kOldest = 222, kNewest = 224;
constexpr std::int64_t kIdentity = 36, kMaxText = 1 << 20, kMinGrid = 40;

// Memory of a tree of floats: a leaf's numbers and mask, an inner node's table and masks.
constexpr double kBytesOfLeaf = 2200, kBytesOfEntry = 8.3;

/// Reads a file forwards, and backwards where it must. What lies behind the end is an exception.
class ForwardFile {
 public:
  explicit ForwardFile(const std::string& path) : block_(1 << 18) {
    if (const std::string problem = why_no_input(path); !problem.empty()) throw std::runtime_error(problem);
    file_.open(path, std::ios::binary);
    if (!file_) throw std::runtime_error("it may not be read");
    file_.seekg(0, std::ios::end);
    size_ = static_cast<std::int64_t>(file_.tellg());
    if (size_ < 0) throw std::runtime_error("there is no such file, or it may not be read");
  }

  std::int64_t size() const { return size_; }
  std::int64_t place() const { return place_; }
  std::int64_t left() const { return size_ - place_; }
  void go_to(std::int64_t place) { place_ = place; }

  void skip(std::int64_t bytes) {
    if (bytes < 0 || bytes > left()) throw std::runtime_error("it is cut off");
    place_ += bytes;
  }

  void read(void* to, std::int64_t bytes) {
    if (bytes > left()) throw std::runtime_error("it is cut off");
    char* out = static_cast<char*>(to);
    while (bytes > 0) {
      if (place_ < begin_ || place_ >= begin_ + filled_) fill();
      const std::int64_t some = std::min(bytes, begin_ + filled_ - place_);
      std::memcpy(out, block_.data() + (place_ - begin_), static_cast<std::size_t>(some));
      out += some;
      place_ += some;
      bytes -= some;
    }
  }

 private:
  void fill() {
    file_.clear();
    file_.seekg(place_);
    file_.read(block_.data(), static_cast<std::streamsize>(block_.size()));
    begin_ = place_;
    filled_ = file_.gcount();
    if (filled_ <= 0) throw std::runtime_error("it is cut off");
  }

  std::ifstream file_;
  std::vector<char> block_;
  std::int64_t size_ = 0, place_ = 0, begin_ = 0, filled_ = 0;
};

using LeafBits = std::array<unsigned char, 64>;

/// The bit mask of a node.
class NodeMask {
 public:
  explicit NodeMask(int bits) : bytes_(static_cast<std::size_t>(bits) / 8) {}
  void read(ForwardFile& from) { from.read(bytes_.data(), static_cast<std::int64_t>(bytes_.size())); }
  std::int64_t size_bytes() const { return static_cast<std::int64_t>(bytes_.size()); }
  std::int64_t count_on() const {
    std::int64_t on = 0;
    for (const unsigned char byte : bytes_)
      for (int bits = byte; bits != 0; bits &= bits - 1) ++on;
    return on;
  }
  bool meets(const NodeMask& other) const {
    for (std::size_t i = 0; i < bytes_.size(); ++i)
      if ((bytes_[i] & other.bytes_[i]) != 0) return true;
    return false;
  }
  bool is(const LeafBits& bits) const {
    return std::equal(bytes_.begin(), bytes_.end(), bits.begin(), bits.end());
  }

 private:
  std::vector<unsigned char> bytes_;
};

class Outline {
 public:
  Outline(const std::string& path, const std::vector<std::string>& wanted) : file_(path), wanted_(wanted) {}

  /// Returns what the wanted grids' trees take in memory.
  double follow() {
    if (file_.size() < 8 || number<std::int64_t>() != kMagic)
      throw std::runtime_error("it is no OpenVDB file");
    const auto version = number<std::uint32_t>();
    if (version < kOldest || version > kNewest)
      throw std::runtime_error("its format is of version " + std::to_string(version));
    file_.skip(8);  // the library's version
    if (number<char>() == 0) throw std::runtime_error("it does not say where its grids are");
    file_.skip(kIdentity);
    metadata();
    const auto grids = number<std::int32_t>();
    if (grids < 0 || grids > file_.size() / kMinGrid) throw bad_part("more grids than it has room for");
    for (std::int32_t i = 0; i < grids; ++i) grid();
    return taken_;
  }

 private:
  static std::runtime_error bad_part(const std::string& what) {
    return std::runtime_error("it is damaged: " + what);
  }

  template <class N>
  N number() {
    N n{};
    file_.read(&n, sizeof n);
    return n;
  }

  /// The library takes a byte that is neither for a bool all the same, which is undefined.
  void truth() {
    if (number<unsigned char>() > 1) throw bad_part("a yes or no that is neither");
  }

  std::string text() {
    const std::int64_t length = number<std::uint32_t>();
    if (length > kMaxText || length > file_.left()) throw bad_part("a text longer than the file");
    std::string words(static_cast<std::size_t>(length), '\0');
    file_.read(words.data(), length);
    return words;
  }

  void metadata() {
    const std::int64_t entries = number<std::uint32_t>();
    for (std::int64_t i = 0; i < entries; ++i) {
      text();  // name
      const std::string type = text();
      const std::int64_t length = number<std::uint32_t>(), begin = file_.place();
      if (length > file_.left()) throw bad_part("metadata longer than the file");
      // The library reads as much as the type takes, whatever the length.
      struct Fixed {
        std::string_view type;
        std::int64_t bytes;
      };
      static constexpr std::array<Fixed, 17> kFixed = {{{"bool", 1},
                                                        {"float", 4},
                                                        {"double", 8},
                                                        {"int32", 4},
                                                        {"int64", 8},
                                                        {"vec2i", 8},
                                                        {"vec2s", 8},
                                                        {"vec2d", 16},
                                                        {"vec3i", 12},
                                                        {"vec3s", 12},
                                                        {"vec3d", 24},
                                                        {"vec4i", 16},
                                                        {"vec4s", 16},
                                                        {"vec4d", 32},
                                                        {"mat4s", 64},
                                                        {"mat4d", 128},
                                                        {"half", 2}}};
      for (const Fixed& fixed : kFixed)
        if (type == fixed.type && length != fixed.bytes)
          throw bad_part("metadata of another length than their type's");
      if (type == "bool") truth();
      if (type == "__delayedload" && length > 0) {
        list_of_leaves(length);
        if (file_.place() > begin + length) throw bad_part("metadata longer than they say");
      }
      file_.go_to(begin + length);
    }
  }

  /// Checks the list of the leaves' compression, by which a leaf may be read without those before it: one
  /// byte for each leaf, then eight bytes for each.
  void list_of_leaves(std::int64_t length) {
    constexpr std::int64_t kMinOfLeaf = 129;  // two masks and a byte
    const std::int64_t end = file_.place() + length, count = number<std::uint32_t>();
    if (count > file_.size() / kMinOfLeaf) throw bad_part("more leaves than it has room for");
    for (const std::int64_t each : {1, 8}) {
      const auto bytes = number<std::uint32_t>();
      if (each == 8 && bytes == 0xFFFFFFFF) return;  // there is no such list
      const std::int64_t begin = file_.place(), room = bytes == 0 ? count * each : std::int64_t{bytes};
      if (room > end - begin) throw bad_part("a list of leaves longer than its place");
      if (bytes > 0) packed(room, padded(count * each));
      file_.go_to(begin + room);
    }
  }

  /// Returns the size to which the library pads a short list before packing
  /// (openvdb/points/StreamCompression.h).
  static std::int64_t padded(std::int64_t bytes) {
    constexpr std::int64_t kMin = 48, kFilled = 128;
    return bytes > kMin && bytes < kFilled ? kFilled : bytes;
  }

  /// Checks that the header of 16 bytes of Blosc's data, which begin here, gives the same packed and unpacked
  /// size.
  void packed(std::int64_t bytes, std::int64_t unpacked) {
    constexpr std::int64_t kHeader = 16;
    if (bytes < kHeader) throw bad_part("packed numbers without a header");
    number<std::uint32_t>();  // versions, flags, size of a number
    const std::int64_t out = number<std::uint32_t>(), block = number<std::uint32_t>(),
                       in = number<std::uint32_t>();
    if (out != unpacked || in != bytes || block > std::max<std::int64_t>(out, 1))
      throw bad_part("packed numbers of another size than what they are for");
    file_.skip(bytes - kHeader);
  }

  /// `count` numbers as the library stores them: as they are, or packed behind their length.
  void numbers(std::int64_t count) {
    constexpr std::uint32_t kZip = 1, kBlosc = 4;
    const std::int64_t bytes = count * (half_ ? 2 : 4);
    if (half_ && count < 1) return;
    if ((compression_ & (kZip | kBlosc)) == 0) {
      file_.skip(bytes);
      return;
    }
    const auto length = number<std::int64_t>();
    if (length <= 0) {
      if (length != -bytes) throw bad_part("numbers of another length than what they are for");
      file_.skip(bytes);
    } else if (length > file_.left() || length > 2 * bytes + 1024) {
      throw bad_part("packed numbers longer than there is room for");
    } else if ((compression_ & kBlosc) != 0) {
      packed(length, bytes);
    } else {
      file_.skip(length);
    }
  }

  /// The numbers of a node of so many entries, with what is said of those that are off.
  void numbers_of(const NodeMask& on, std::int64_t entries) {
    constexpr std::uint32_t kActiveAlone = 2;
    enum : int { off_minus = 1, one_off, selection, selection_one_off, selection_two_off, all };
    const int kind = number<std::int8_t>();
    if (kind < 0 || kind > all) throw bad_part("numbers of no known kind");
    if (kind == one_off || kind == selection_one_off || kind == selection_two_off) file_.skip(4);
    if (kind == selection_two_off) file_.skip(4);
    if (kind >= selection && kind <= selection_two_off) file_.skip(on.size_bytes());
    numbers((compression_ & kActiveAlone) != 0 && kind != all ? on.count_on() : entries);
  }

  void transform() {
    const std::string kind = text();
    struct Map {
      std::string_view name;
      std::int64_t bytes;
    };
    static constexpr std::array<Map, 7> kMaps = {{{"AffineMap", 128},
                                                  {"UnitaryMap", 128},
                                                  {"ScaleMap", 120},
                                                  {"UniformScaleMap", 120},
                                                  {"TranslationMap", 24},
                                                  {"ScaleTranslateMap", 144},
                                                  {"UniformScaleTranslateMap", 144}}};
    for (const Map& map : kMaps)
      if (kind == map.name) return file_.skip(map.bytes);
    throw std::runtime_error("a grid is not placed by a linear transform");
  }

  /// The tree of a grid of floats (two layers of inner nodes, of 32 and 16 to the side, and leaves of 8), as
  /// InternalNode.h and LeafNode.h of the library read it: first where nodes are, then what leaves hold.
  void tree() {
    constexpr int kTop = 4096;  // voxels to the side of a node below the root
    if (number<std::int32_t>() != 1) throw bad_part("a tree of several buffers");
    file_.skip(4);  // background
    const std::int64_t tiles = number<std::uint32_t>(), children = number<std::uint32_t>();
    if (tiles > file_.left() / 17 || children > file_.left() / (2 * 32768 / 8))
      throw bad_part("more nodes than it has room for");
    std::set<std::array<std::int32_t, 3>> places;
    const auto place = [&] {
      std::array<std::int32_t, 3> at{};
      file_.read(at.data(), sizeof at);
      for (const std::int32_t c : at)
        if (c % kTop != 0) throw bad_part("a node that is at no place of a node");
      if (!places.insert(at).second) throw bad_part("two nodes at one place");
    };
    for (std::int64_t i = 0; i < tiles; ++i) {
      place();
      file_.skip(4);
      truth();
    }
    std::vector<LeafBits> leaves;
    for (std::int64_t i = 0; i < children; ++i) {
      place();
      inner<32768>(leaves);
    }
    NodeMask on(512);
    for (const LeafBits& leaf : leaves) {
      on.read(file_);
      if (!on.is(leaf)) throw bad_part("a leaf with two masks that differ");
      numbers_of(on, 512);
    }
  }

  template <int kEntries>
  void inner(std::vector<LeafBits>& leaves) {
    constexpr int kBelow = kEntries == 32768 ? 4096 : 512;
    taken_ += kBytesOfEntry * kEntries;
    NodeMask children(kEntries), on(kEntries);
    children.read(file_);
    on.read(file_);
    if (children.meets(on)) throw bad_part("a node that is a number as well");
    numbers_of(on, kEntries);
    const std::int64_t count = children.count_on();
    if (count > file_.left() / (kBelow / 8)) throw bad_part("more nodes than it has room for");
    for (std::int64_t i = 0; i < count; ++i) {
      if constexpr (kBelow == 512) {
        taken_ += kBytesOfLeaf;
        leaves.emplace_back();
        file_.read(leaves.back().data(), sizeof(LeafBits));
      } else {
        inner<kBelow>(leaves);
      }
    }
  }

  void grid() {
    // A suffix that distinguishes equal names follows the name, after a character of its own.
    const std::string all = text(), name = all.substr(0, all.find('\x1e')), type = text();
    const bool is_instance = !text().empty();
    const auto begin = number<std::int64_t>(), values = number<std::int64_t>(), end = number<std::int64_t>();
    if (begin < file_.place() || values < begin || end < values) throw bad_part("a grid's place");
    if (end > file_.size()) throw std::runtime_error("it is cut off: a grid ends behind the end of the file");
    file_.go_to(begin);
    compression_ = number<std::uint32_t>();
    if (compression_ > 7) throw bad_part("a compression of no known kind");
    metadata();
    constexpr std::string_view kFloats = "Tree_float_5_4_3", kHalf = "_HalfFloat";
    half_ = ends_with(type, kHalf);
    // Others are never read.
    if (type.compare(0, kFloats.size(), kFloats) == 0) {
      const double before = taken_;
      transform();
      if (!is_instance) tree();
      if (std::find(wanted_.begin(), wanted_.end(), name) == wanted_.end()) taken_ = before;
    }
    if (file_.place() > end) throw bad_part("a grid longer than its place");
    file_.go_to(end);
  }

  ForwardFile file_;
  const std::vector<std::string>& wanted_;
  double taken_ = 0.0;
  std::uint32_t compression_ = 0;
  bool half_ = false;
};

}  // namespace

VdbOutline vdb_outline(const std::string& path, const std::vector<std::string>& wanted) {
  VdbOutline found;
  try {
    found.tree_bytes = Outline(path, wanted).follow();
  } catch (const std::runtime_error& error) {
    found.complaint = error.what();
  }
  return found;
}

}  // namespace vegard::sim
