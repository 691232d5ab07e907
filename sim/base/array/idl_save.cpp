// Reads IDL save files (.sav), as far as the maps of directions of THEMIS, REGO and TREx use them: variables
// that are numbers, texts, arrays of numbers, or structures with one element of these
// ("skymap/full_azimuth"), with records that are uncompressed or compressed by zlib.
//
// The format is that of "Unofficial Format Specification for the IDL SAVE File" (C. Markwardt): records in
// XDR. Records of other kinds (routines, system variables, heap variables) and variables of other types are
// skipped; variables with an invalid description are refused.
//
// Texts become attributes of their structure.
#include "sim/base/array/array_format.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"
#include "sim/base/text.h"

namespace vegard::sim {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 29;
constexpr int kDeepestPart = 6;
constexpr std::uint32_t kMaxTags = 4096;
enum : std::uint32_t { kVariableRecord = 2, kEndRecord = 6 };
enum : std::uint32_t { kArrayFlag = 4, kSystemFlag = 2, kStructureFlag = 32 };
enum : std::uint32_t { kTextType = 7, kStructureType = 8 };

/// IDL's types of numbers; false of all others.
bool kind_of_idl(std::uint32_t type, ArrayKind& kind) {
  switch (type) {
    case 1:
      kind = ArrayKind::u8;
      return true;
    case 2:
      kind = ArrayKind::i16;
      return true;
    case 3:
      kind = ArrayKind::i32;
      return true;
    case 4:
      kind = ArrayKind::f32;
      return true;
    case 5:
      kind = ArrayKind::f64;
      return true;
    case 12:
      kind = ArrayKind::u16;
      return true;
    case 13:
      kind = ArrayKind::u32;
      return true;
    case 14:
      kind = ArrayKind::i64;
      return true;
    case 15:
      kind = ArrayKind::u64;
      return true;
    default:
      return false;
  }
}

struct IdlShape {
  std::uint64_t elements = 1, bytes = 0;
  std::vector<std::uint64_t> dims;  ///< the first running fastest
};

struct Structure;
struct Tag {
  std::string name;
  std::uint32_t type = 0, flags = 0;
  IdlShape shape;
  const Structure* structure = nullptr;
};
struct Structure {
  std::string name;
  std::vector<Tag> tags;
};

/// A record's numbers and texts, one after another (XDR: four bytes at least, high byte first).
class Xdr {
  static constexpr std::uint32_t kMaxTextBytes = 1 << 16;

 public:
  Xdr(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  std::uint32_t number() { return static_cast<std::uint32_t>(wide(4)); }
  void pass(std::uint64_t count) { take(count); }
  /// A length, and so many letters.
  std::string text() {
    const std::uint32_t length = number();
    if (length > kMaxTextBytes) throw bad_record("has a text of more than 64 kB");
    std::string value(take(length));
    align();
    return value;
  }
  std::string_view take(std::uint64_t count) {
    if (count > bytes_.size() - at_) throw bad_record("ends too early");
    const std::string_view taken = bytes_.substr(at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return taken;
  }
  void align() { pass((4 - at_ % 4) % 4); }
  bool is_at_end() const { return at_ == bytes_.size(); }

  Error bad_record(const std::string& what) const { return damaged(file_, "a record of it " + what); }

 private:
  std::uint64_t wide(std::size_t size) {
    std::uint64_t value = 0;
    for (const char byte : take(size)) value = value << 8 | static_cast<unsigned char>(byte);
    return value;
  }
  std::string_view bytes_;
  const std::string& file_;
  std::size_t at_ = 0;
};

class IdlSave : public ArrayFile {
 public:
  IdlSave(const std::string& name, std::string_view bytes) : ArrayFile(name, "IDL") {
    const RandomBytes file(name, bytes);
    if (file.size() > kMaxBytes) throw unreadable(name_, "the file is larger than 512 MB");
    const std::string all = file.bytes(0, file.size());
    constexpr std::size_t kBegin = 4;
    if (all.size() < kBegin) throw unreadable(name_, "the file is truncated").hint(kCopyAgain);
    const bool is_packed = all[3] == '\6';
    std::size_t place = kBegin;
    for (std::size_t records = 0;; ++records) {
      if (records > kMaxArrays) throw unreadable(name_, "it holds too many records");
      constexpr std::size_t kHead = 16;
      if (all.size() - place < kHead) throw truncated(name_, "it has no last record");
      Xdr head(std::string_view(all).substr(place, kHead), name_);
      const std::uint32_t type = head.number();
      const std::uint64_t low = head.number(), next = low | static_cast<std::uint64_t>(head.number()) << 32;
      if (type == kEndRecord) break;
      if (next <= place + kHead - 1 || next > all.size())
        throw unreadable(name_, "the file is truncated, or damaged: a record ends where there is none")
            .hint(kCopyAgain);
      if (type == kVariableRecord) {
        const std::string_view stored =
            std::string_view(all).substr(place + kHead, static_cast<std::size_t>(next) - place - kHead);
        take_variable(is_packed ? unpacked(stored) : std::string(stored));
      }
      place = static_cast<std::size_t>(next);
    }
  }

 private:
  std::string unpacked(std::string_view packed) {
    ByteStream stream = ByteStream::of_zlib(packed, name_);
    std::string all;
    constexpr std::size_t kAtOnce = std::size_t{1} << 20;
    for (;;) {
      const std::size_t at = all.size();
      all.resize(at + kAtOnce);
      const std::size_t got = stream.read(all.data() + at, kAtOnce);
      all.resize(at + got);
      if (got < kAtOnce) return all;
      if (all.size() + kept_bytes_ > kMaxBytes) throw unreadable(name_, "it unpacks to more than 512 MB");
    }
  }

  IdlShape shape_of(Xdr& xdr) {
    constexpr std::uint32_t kOfThirtyTwoBits = 8, kMaxDims = 8;
    if (xdr.number() != kOfThirtyTwoBits)
      throw unreadable(name_, "an array in it is described in a way that is not read")
          .expected("arrays below 2 GB");
    xdr.pass(4);
    IdlShape shape;
    shape.bytes = xdr.number();
    shape.elements = xdr.number();
    const std::uint32_t dims = xdr.number();
    xdr.pass(8);
    const std::uint32_t stored = xdr.number();
    if (dims < 1 || dims > kMaxDims || stored < dims || stored > kMaxDims)
      throw xdr.bad_record("has an impossible shape");
    std::uint64_t elements = 1;
    for (std::uint32_t d = 0; d < stored; ++d) {
      const std::uint64_t length = xdr.number();
      if (d >= dims) continue;
      shape.dims.push_back(length);
      if (length == 0 || length > kMaxBytes / elements) throw xdr.bad_record("has an impossible shape");
      elements *= length;
    }
    if (elements != shape.elements) throw xdr.bad_record("has a shape that contradicts itself");
    return shape;
  }

  const Structure* structure_of(Xdr& xdr, int depth) {
    constexpr std::uint32_t kBegin = 9, kPredefined = 1, kInherits = 2, kIsClass = 4;
    if (depth > kDeepestPart || xdr.number() != kBegin) throw xdr.bad_record("has an impossible structure");
    Structure made;
    made.name = xdr.text();
    const std::uint32_t flags = xdr.number(), tags = xdr.number();
    xdr.pass(4);
    if (tags > kMaxTags) throw xdr.bad_record("has a structure of too many parts");
    if ((flags & kPredefined) != 0) {
      const auto known = std::find_if(structures_.begin(), structures_.end(),
                                      [&](const Structure& one) { return one.name == made.name; });
      if (known == structures_.end()) throw xdr.bad_record("has a structure that is described nowhere");
      return &*known;
    }
    made.tags.resize(tags);
    for (Tag& tag : made.tags) {
      if (xdr.number() == 0xffffffffU) xdr.pass(8);
      tag.type = xdr.number();
      tag.flags = xdr.number();
    }
    for (Tag& tag : made.tags) tag.name = lowered(xdr.text());
    for (Tag& tag : made.tags)
      if ((tag.flags & kArrayFlag) != 0) tag.shape = shape_of(xdr);
    for (Tag& tag : made.tags)
      if ((tag.flags & kStructureFlag) != 0) tag.structure = structure_of(xdr, depth + 1);
    if ((flags & (kInherits | kIsClass)) != 0)
      throw unreadable(name_, "it holds objects of a class, which are not read");
    if (structures_.size() >= kMaxArrays) throw unreadable(name_, "it holds too many structures");
    structures_.push_back(std::move(made));
    return &structures_.back();
  }

  void take_variable(std::string content) {
    kept_bytes_ += content.size();
    if (kept_bytes_ > kMaxBytes) throw unreadable(name_, "it holds more than 512 MB");
    kept_.push_back(std::move(content));
    Xdr xdr(kept_.back(), name_);
    Tag variable;
    variable.name = lowered(xdr.text());
    variable.type = xdr.number();
    variable.flags = xdr.number();
    if ((variable.flags & kSystemFlag) != 0) return;
    if ((variable.flags & (kArrayFlag | kStructureFlag)) != 0) variable.shape = shape_of(xdr);
    if ((variable.flags & kStructureFlag) != 0) variable.structure = structure_of(xdr, 0);
    constexpr std::uint32_t kValuesFollow = 7;
    if (variable.structure == nullptr && !is_read(variable.type)) return;
    if (xdr.number() != kValuesFollow) throw xdr.bad_record("has no values where they should be");
    take_values(xdr, variable, "", 0);
  }

  static bool is_read(std::uint32_t type) {
    ArrayKind kind{};
    return type == kTextType || kind_of_idl(type, kind);
  }

  void take_values(Xdr& xdr, const Tag& tag, const std::string& within, int depth) {
    constexpr std::size_t kMaxSteps = 10000000;
    if (++steps_ > kMaxSteps) throw xdr.bad_record("has too many parts");
    if (within.size() + tag.name.size() > kMaxNameLetters)
      throw xdr.bad_record("has a name of more than 256 letters");
    const std::string path = within.empty() ? tag.name : within + "/" + tag.name;
    if (tag.structure != nullptr) {
      if (depth > kDeepestPart || tag.shape.elements > kMaxArrays)
        throw xdr.bad_record("has too many structures");
      // Of arrays of structures the first stands for all; the others are gone through.
      steps_ += static_cast<std::size_t>(tag.shape.elements);
      for (std::uint64_t i = 0; i < tag.shape.elements; ++i)
        for (const Tag& part : tag.structure->tags)
          take_values(xdr, part, i == 0 ? path : path + "[" + std::to_string(i) + "]", depth + 1);
      return;
    }
    const bool is_array = (tag.flags & kArrayFlag) != 0;
    if (tag.type == kTextType) {
      if (tag.shape.elements > kMaxTexts) throw xdr.bad_record("has too many texts");
      for (std::uint64_t i = 0; i < tag.shape.elements; ++i) {
        // Its length stands there twice, unless it is 0.
        const std::uint32_t length = xdr.number();
        const std::string text = length > 0 ? xdr.text() : std::string();
        if (is_array) continue;
        word_bytes_ += within.size() + tag.name.size() + text.size();
        if (word_bytes_ > kMaxWordBytes) throw xdr.bad_record("has too many texts");
        words_[within].emplace_back(tag.name, text);
      }
      return;
    }
    StoredArray array;
    if (!kind_of_idl(tag.type, array.kind))
      throw unreadable(name_, "'" + path + "' is of a type that is not read").expected("numbers and texts");
    array.name = path;
    if (is_array) array.dims.assign(tag.shape.dims.rbegin(), tag.shape.dims.rend());
    constexpr std::uint32_t kBytes = 1, kShorts = 2, kWords = 12;
    const std::size_t size = size_of(array.kind);
    // Bytes are preceded by how many they are; short integers take four bytes each.
    if (tag.type == kBytes) xdr.pass(4);
    const bool is_wide = tag.type == kShorts || tag.type == kWords;
    const std::uint64_t count = array.count();
    const std::string_view stored = xdr.take(count * (is_wide ? 4 : size));
    xdr.align();
    if (arrays_.size() >= kMaxArrays) throw unreadable(name_, "it holds too many variables");
    arrays_.push_back(std::move(array));
    values_.push_back({stored, is_wide});
  }

  std::string read_block(const StoredArray& array, const std::vector<std::uint64_t>& start,
                         const std::vector<std::uint64_t>& count) override {
    const Values& values = values_[static_cast<std::size_t>(&array - arrays_.data())];
    const std::size_t size = size_of(array.kind), stride = values.is_wide ? 4 : size;
    std::string all(static_cast<std::size_t>(array.count()) * size, '\0');
    for (std::size_t i = 0; i * size < all.size(); ++i)
      std::reverse_copy(values.stored.begin() + static_cast<std::ptrdiff_t>((i + 1) * stride - size),
                        values.stored.begin() + static_cast<std::ptrdiff_t>((i + 1) * stride),
                        all.begin() + static_cast<std::ptrdiff_t>(i * size));
    return block_of(all, array, start, count);
  }

  static constexpr std::uint64_t kMaxTexts = 1 << 16;
  static constexpr std::size_t kMaxNameLetters = 256;
  std::size_t word_bytes_ = 0;

  struct Values {
    std::string_view stored;
    bool is_wide = false;
  };
  std::deque<std::string> kept_;      ///< the variables' records
  std::deque<Structure> structures_;  ///< as they have been described
  std::vector<Values> values_;        ///< of each array
  std::uint64_t kept_bytes_ = 0;
  std::size_t steps_ = 0;
};

}  // namespace

bool is_idl_save(std::string_view beginning) {
  const std::string_view start = beginning.substr(0, 4);
  return start == std::string_view("SR\0\4", 4) || start == std::string_view("SR\0\6", 4);
}

std::unique_ptr<ArrayFile> open_idl_save(const std::string& name, std::string_view bytes) {
  return std::make_unique<IdlSave>(name, bytes);
}

}  // namespace vegard::sim
