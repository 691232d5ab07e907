// Reads NASA's CDF files of version 3, as far as files of ground-based imagers use them (hourly images of
// THEMIS and REGO and their maps of directions): numeric variables (integers, floats, CDF_EPOCH and TT2000)
// of either kind (r and z), row-major or column-major, in blocks that are uncompressed, or compressed by gzip
// or run lengths of zeros; also files compressed by gzip as a whole. Attributes are ignored.
//
// The format: CDF Internal Format Description, version 3 (NASA's Space Physics Data Facility).
//
// Files of version 2, multi-file CDFs and VAX numbers are refused; variables with another compression are
// refused when they are read.
#include "sim/base/array/array_format.h"

#include <algorithm>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"

namespace vegard::sim {
namespace {

constexpr std::string_view kVersion3("\xCD\xF3\x00\x01", 4);
constexpr std::string_view kVersion26("\xCD\xF2\x60\x02", 4);
constexpr std::string_view kPlain("\x00\x00\xFF\xFF", 4);
constexpr std::string_view kPacked("\xCC\xCC\x00\x01", 4);
constexpr std::uint64_t kMagicBytes = 8;
constexpr std::size_t kNameBytes = 256;
constexpr std::uint64_t kMaxUnpackedFile = std::uint64_t{1} << 29;
constexpr std::size_t kMaxBlocks = std::size_t{1} << 20;
constexpr int kDeepestIndex = 8;
/// The types of the records that are read.
enum RecordType : std::uint64_t {
  kDescriptor = 1,
  kGlobal = 2,
  kRVariable = 3,
  kIndex = 6,
  kValues = 7,
  kZVariable = 8,
  kPackedFile = 10,
  kPacking = 11,
  kPackedValues = 13,
};
constexpr std::uint64_t kRowsFirst = 1, kInOneFile = 2;
constexpr std::uint64_t kVariesByRecord = 1, kIsPacked = 4;
constexpr std::uint64_t kNoPacking = 0, kRunsOfZeros = 1, kGzip = 5;

/// The numbers of a record's head, one after another.
class Fields {
 public:
  explicit Fields(std::string bytes) : bytes_(std::move(bytes)) {}
  std::uint64_t four() { return next(4); }
  std::uint64_t eight() { return next(8); }
  void pass(std::size_t count) { at_ = std::min(bytes_.size(), at_ + count); }
  std::string text(std::size_t count) {
    std::string value = bytes_.substr(std::min(at_, bytes_.size()), count);
    pass(count);
    value.resize(std::min(value.size(), value.find('\0')));
    return value;
  }
  bool is_short() const { return is_short_; }

 private:
  std::uint64_t next(std::size_t size) {
    if (bytes_.size() - at_ < size) {
      is_short_ = true;
      return 0;
    }
    at_ += size;
    return unsigned_at(bytes_, at_ - size, size);
  }
  std::string bytes_;
  std::size_t at_ = 0;
  bool is_short_ = false;
};

/// True if CDF's type of numbers can be read.
bool kind_of_type(std::uint64_t type, ArrayKind& kind, ArrayClock& clock) {
  clock = ArrayClock::none;
  switch (type) {
    case 1:
    case 41:
      kind = ArrayKind::i8;
      return true;
    case 11:
      kind = ArrayKind::u8;
      return true;
    case 2:
      kind = ArrayKind::i16;
      return true;
    case 12:
      kind = ArrayKind::u16;
      return true;
    case 4:
      kind = ArrayKind::i32;
      return true;
    case 14:
      kind = ArrayKind::u32;
      return true;
    case 8:
      kind = ArrayKind::i64;
      return true;
    case 21:
    case 44:
      kind = ArrayKind::f32;
      return true;
    case 22:
    case 45:
      kind = ArrayKind::f64;
      return true;
    case 31:
      kind = ArrayKind::f64;
      clock = ArrayClock::cdf_epoch;
      return true;
    case 33:
      kind = ArrayKind::i64;
      clock = ArrayClock::tt2000;
      return true;
    default:
      return false;
  }
}

/// Returns an encoding's order of bytes: 'b' (big endian), 'l', or 0 for encodings that are not read (VAX).
char order_of_encoding(std::uint64_t encoding) {
  switch (encoding) {
    case 1:
    case 2:
    case 5:
    case 7:
    case 9:
    case 11:
    case 12:
    case 18:
      return 'b';
    case 4:
    case 6:
    case 13:
    case 17:
      return 'l';
    default:
      return 0;
  }
}

struct Block {
  std::uint64_t first = 0, last = 0, place = 0;  ///< records, and where they lie
};

struct CdfVariable {
  std::uint64_t index = 0, packing = kNoPacking;
  bool varies = true;
  std::uint64_t record_bytes = 0;
  bool is_indexed = false;
  std::vector<Block> blocks;  ///< in order, once they are asked for
};

class CdfFile : public ArrayFile {
 public:
  CdfFile(const std::string& name, std::string_view bytes) : ArrayFile(name, "CDF") {
    file_ = std::make_unique<RandomBytes>(name, bytes);
    const std::string magic = file_->bytes(0, kMagicBytes);
    if (magic.substr(0, kVersion3.size()) != kVersion3)
      throw unreadable(name_, "this is a CDF file of version 2")
          .expected("version 3")
          .hint("NASA's cdfconvert makes one of the other");
    if (magic.substr(kVersion3.size()) == kPacked) unpack_file();
    read_descriptor();
  }

 private:
  /// A record's head behind its size and type, which are to be these.
  Fields record(std::uint64_t place, RecordType type, std::size_t max_bytes) const {
    constexpr std::size_t kHead = 12;
    const std::string head = file_->bytes(place, kHead);
    const std::uint64_t size = unsigned_at(head, 0, 8);
    if (unsigned_at(head, 8, 4) != type || size < kHead)
      throw damaged(name_, "a record of kind " + std::to_string(type) + " is not where it is said to be");
    return Fields(file_->bytes(place + kHead, std::min<std::uint64_t>(size - kHead, max_bytes)));
  }
  std::uint64_t type_at(std::uint64_t place) const {
    constexpr std::uint64_t kTypeAt = 8;
    return unsigned_at(file_->bytes(place + kTypeAt, 4), 0, 4);
  }

  void unpack_file() {
    constexpr std::size_t kEnough = 64;
    Fields packed = record(kMagicBytes, kPackedFile, kEnough);
    const std::uint64_t packing = packed.eight(), size = packed.eight();
    constexpr std::uint64_t kDataAt = 32;
    const std::uint64_t stored = unsigned_at(file_->bytes(kMagicBytes, 8), 0, 8);
    if (packing_of(packing) != kGzip)
      throw unreadable(name_, "it is packed as a whole in a way that is not read").expected("gzip");
    if (size > kMaxUnpackedFile)
      throw unreadable(name_, "it claims to unpack to " + std::to_string(size) + " bytes")
          .expected("at most 512 MB")
          .hint("unpack it first");
    if (stored < kDataAt) throw damaged(name_, "its packed part is cut short");
    unpacked_ =
        std::string(kMagicBytes, '\0') + gunzip(file_->bytes(kMagicBytes + kDataAt, stored - kDataAt), size);
    file_ = std::make_unique<RandomBytes>(name_, std::string_view(unpacked_));
  }

  std::uint64_t packing_of(std::uint64_t place) const {
    constexpr std::size_t kEnough = 64;
    return record(place, kPacking, kEnough).four();
  }

  std::string gunzip(const std::string& packed, std::uint64_t size) const {
    ByteStream stream(packed, name_);
    if (!stream.is_packed()) throw damaged(name_, "what is said to be packed by gzip is not");
    // Room is made as bytes come.
    std::string all;
    constexpr std::size_t kAtOnce = std::size_t{1} << 22;
    while (all.size() < size) {
      const std::size_t at = all.size();
      const std::size_t count = std::min<std::size_t>(kAtOnce, static_cast<std::size_t>(size) - at);
      all.resize(at + count);
      const std::size_t got = stream.read(all.data() + at, count);
      if (got < count) throw damaged(name_, "a packed part of it is too short");
    }
    return all;
  }

  void read_descriptor() {
    constexpr std::size_t kEnough = 64;
    Fields descriptor = record(kMagicBytes, kDescriptor, kEnough);
    const std::uint64_t global_at = descriptor.eight();
    descriptor.pass(8);
    const std::uint64_t encoding = descriptor.four(), flags = descriptor.four();
    order_ = order_of_encoding(encoding);
    if (order_ == 0)
      throw unreadable(name_, "its numbers are encoded in a way that is not read").expected("IEEE numbers");
    if ((flags & kInOneFile) == 0)
      throw unreadable(name_, "its variables are in files of their own").expected("one file");
    rows_first_ = (flags & kRowsFirst) != 0;
    Fields global = record(global_at, kGlobal, 72 + 4 * kMaxArrayDims);
    const std::uint64_t r_head = global.eight(), z_head = global.eight();
    global.pass(16);
    global.pass(12);
    const std::uint64_t r_dims = global.four();
    global.pass(4 + 8 + 12);
    std::vector<std::uint64_t> r_lengths;
    if (r_dims >= kMaxArrayDims) throw unreadable(name_, "its variables have too many dimensions");
    for (std::uint64_t d = 0; d < r_dims; ++d) r_lengths.push_back(global.four());
    if (global.is_short()) throw damaged(name_, "its record of what it holds is cut short");
    take_variables(r_head, kRVariable, r_lengths);
    take_variables(z_head, kZVariable, {});
  }

  void take_variables(std::uint64_t place, RecordType type, const std::vector<std::uint64_t>& r_lengths) {
    for (std::size_t seen = 0; place != 0; ++seen) {
      if (seen >= kMaxArrays)
        throw unreadable(name_, "it holds more than " + std::to_string(kMaxArrays) + " variables");
      constexpr std::size_t kEnough = 72 + kNameBytes + 4 + 8 * kMaxArrayDims + 64;
      Fields head = record(place, type, kEnough);
      place = head.eight();
      const std::uint64_t data_type = head.four(), last_record = head.four();
      CdfVariable variable;
      variable.index = head.eight();
      head.pass(8);
      const std::uint64_t flags = head.four();
      head.pass(16);
      const std::uint64_t elements = head.four();
      head.pass(4);
      const std::uint64_t packing_at = head.eight();
      head.pass(4);
      StoredArray array;
      array.name = head.text(kNameBytes);
      std::vector<std::uint64_t> lengths = r_lengths;
      if (type == kZVariable) {
        const std::uint64_t dims = head.four();
        if (dims >= kMaxArrayDims) continue;
        lengths.clear();
        for (std::uint64_t d = 0; d < dims; ++d) lengths.push_back(head.four());
      }
      for (const std::uint64_t length : lengths)
        if (head.four() != 0) array.dims.push_back(length);
      if (head.is_short()) throw damaged(name_, "its record of a variable is cut short");
      if (array.name.empty()) continue;  // nobody could ask for it
      if (!kind_of_type(data_type, array.kind, array.clock) || elements != 1) continue;
      variable.packing = (flags & kIsPacked) != 0 ? packing_of(packing_at) : kNoPacking;
      variable.varies = (flags & kVariesByRecord) != 0;
      const std::uint64_t in_record = array.count();
      if (in_record > kMaxBlockBytes / size_of(array.kind)) continue;
      variable.record_bytes = in_record * size_of(array.kind);
      if (!rows_first_) std::reverse(array.dims.begin(), array.dims.end());
      array.columns_first = !rows_first_;
      // The number of the last record is -1 where there is none.
      const std::uint64_t records = last_record == 0xffffffffU ? 0 : last_record + 1;
      if (variable.varies) array.dims.insert(array.dims.begin(), records);
      if (records == 0 || variable.record_bytes == 0) continue;
      arrays_.push_back(std::move(array));
      variables_.push_back(std::move(variable));
    }
  }

  void take_index(std::uint64_t place, int depth, std::size_t& seen, std::vector<Block>& blocks) const {
    while (place != 0) {
      if (++seen > kMaxBlocks || depth > kDeepestIndex) throw damaged(name_, "its index has no end");
      constexpr std::size_t kEntryBytes = 16, kMaxEntries = 4096;
      Fields head = record(place, kIndex, 16 + kEntryBytes * kMaxEntries);
      const std::uint64_t next = head.eight(), entries = head.four(), used = head.four();
      if (entries > kMaxEntries || used > entries) throw damaged(name_, "its index makes no sense");
      std::vector<Block> own(static_cast<std::size_t>(entries));
      for (Block& block : own) block.first = head.four();
      for (Block& block : own) block.last = head.four();
      for (Block& block : own) block.place = head.eight();
      if (head.is_short()) throw damaged(name_, "its index is cut short");
      own.resize(static_cast<std::size_t>(used));
      for (const Block& block : own) {
        if (block.last < block.first || blocks.size() >= kMaxBlocks)
          throw damaged(name_, "its index makes no sense");
        if (type_at(block.place) == kIndex)
          take_index(block.place, depth + 1, seen, blocks);
        else
          blocks.push_back(block);
      }
      place = next;
    }
  }

  /// The block of a variable that a record lies in.
  const Block& block_with(CdfVariable& variable, std::uint64_t number, const std::string& name) {
    if (!variable.is_indexed) {
      std::size_t seen = 0;
      take_index(variable.index, 0, seen, variable.blocks);
      std::stable_sort(variable.blocks.begin(), variable.blocks.end(),
                       [](const Block& a, const Block& b) { return a.first < b.first; });
      variable.is_indexed = true;
    }
    const auto behind = std::upper_bound(variable.blocks.begin(), variable.blocks.end(), number,
                                         [](std::uint64_t n, const Block& block) { return n < block.first; });
    if (behind == variable.blocks.begin() || std::prev(behind)->last < number)
      throw unreadable(name_, "of '" + name + "' record " + std::to_string(number) + " is missing");
    return *std::prev(behind);
  }

  std::string record_bytes(std::size_t index, std::uint64_t number) {
    CdfVariable& variable = variables_[index];
    const std::string& name = arrays_[index].name;
    const Block& block = block_with(variable, number, name);
    const std::uint64_t type = type_at(block.place),
                        in_block = (number - block.first) * variable.record_bytes;
    constexpr std::uint64_t kValuesAt = 12, kPackedValuesAt = 24, kSizeAt = 16;
    if (type == kValues) return file_->bytes(block.place + kValuesAt + in_block, variable.record_bytes);
    if (type != kPackedValues) throw damaged(name_, "'" + name + "' is not where its index says");
    if (kept_place_ != block.place) {
      const std::uint64_t stored = unsigned_at(file_->bytes(block.place + kSizeAt, 8), 0, 8);
      const std::uint64_t records = block.last - block.first + 1;
      if (records > kMaxBlockBytes / variable.record_bytes)
        throw unreadable(name_, "a packed block of '" + name + "' claims more than 512 MB");
      const std::string packed = file_->bytes(block.place + kPackedValuesAt, stored);
      const std::uint64_t size = records * variable.record_bytes;
      if (variable.packing == kGzip)
        kept_ = gunzip(packed, size);
      else if (variable.packing == kRunsOfZeros)
        kept_ = with_runs(packed, size);
      else
        throw unreadable(name_, "'" + name + "' is packed in a way that is not read")
            .expected("gzip, or runs of zeros");
      kept_place_ = block.place;
    }
    // Two indices may claim one block, with other sizes.
    if (in_block > kept_.size() || variable.record_bytes > kept_.size() - in_block)
      throw damaged(name_, "a packed block of '" + name + "' is smaller than its index says");
    return kept_.substr(static_cast<std::size_t>(in_block), static_cast<std::size_t>(variable.record_bytes));
  }

  /// A zero is followed by how many more there are.
  std::string with_runs(const std::string& packed, std::uint64_t size) const {
    std::string all;
    for (std::size_t i = 0; i < packed.size() && all.size() < size; ++i) {
      if (packed[i] != '\0') {
        all += packed[i];
      } else {
        if (++i == packed.size()) break;
        all.append(static_cast<std::size_t>(static_cast<unsigned char>(packed[i])) + 1, '\0');
      }
    }
    if (all.size() != size) throw damaged(name_, "a packed part of it has another size than it says");
    return all;
  }

  std::string read_block(const StoredArray& array, const std::vector<std::uint64_t>& start,
                         const std::vector<std::uint64_t>& count) override {
    const auto index = static_cast<std::size_t>(&array - arrays_.data());
    StoredArray one = array;
    std::vector<std::uint64_t> start_in = start, count_in = count;
    std::uint64_t first = 0, records = 1;
    if (variables_[index].varies) {
      first = start[0];
      records = count[0];
      one.dims.erase(one.dims.begin());
      start_in.erase(start_in.begin());
      count_in.erase(count_in.begin());
    }
    std::string all;
    for (std::uint64_t i = 0; i < records; ++i)
      all += block_of(record_bytes(index, first + i), one, start_in, count_in);
    const std::size_t size = size_of(array.kind);
    if (order_ == 'b' && size > 1)
      for (std::size_t at = 0; at + size <= all.size(); at += size)
        std::reverse(all.begin() + static_cast<std::ptrdiff_t>(at),
                     all.begin() + static_cast<std::ptrdiff_t>(at + size));
    return all;
  }

  std::unique_ptr<RandomBytes> file_;
  std::string unpacked_;  ///< of a file that was packed as a whole
  char order_ = 'b';
  bool rows_first_ = true;
  std::vector<CdfVariable> variables_;  ///< of each array
  std::string kept_;                    ///< the last block that was unpacked, and where it lies
  std::uint64_t kept_place_ = 0;
};

}  // namespace

bool is_cdf(std::string_view beginning) {
  if (beginning.size() < kMagicBytes) return false;
  const std::string_view version = beginning.substr(0, 4), packing = beginning.substr(4, 4);
  return (version == kVersion3 || version == kVersion26) && (packing == kPlain || packing == kPacked);
}

std::unique_ptr<ArrayFile> open_cdf(const std::string& name, std::string_view bytes) {
  return std::make_unique<CdfFile>(name, bytes);
}

}  // namespace vegard::sim
