// Reads HDF5 files, also those of MATLAB 7.3. Only hdf5_file.cpp includes the library, which runs in a
// separate process (sim/base/file/child_worker.h) because it crashes on damaged files.
//
// It reads datasets of integers, floats and texts, of any layout inside of the file, with the filters of the
// library (deflate, shuffle, checksums). Of a table of records each column of numbers is an array, named
// "TABLE/COLUMN". Links to other files, and data in other files, are not followed.
#include "sim/base/array/array_format.h"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "sim/base/error.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kMaxTextBytesOfOne = 1 << 16;
constexpr hsize_t kMaxChunkBytes = hsize_t{1} << 28;

/// One of the library's handles. What it was got for is open() false of.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool is_open() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

ArrayKind array_kind_of(hid_t type, bool& is_known) {
  is_known = true;
  const std::size_t size = H5Tget_size(type);
  const H5T_class_t sort = H5Tget_class(type);
  if (sort == H5T_STRING) return ArrayKind::text;
  if (sort == H5T_FLOAT && size == 4) return ArrayKind::f32;
  if (sort == H5T_FLOAT && size == 8) return ArrayKind::f64;
  if (sort == H5T_INTEGER) {
    const bool is_signed = H5Tget_sign(type) != H5T_SGN_NONE;
    if (size == 1) return is_signed ? ArrayKind::i8 : ArrayKind::u8;
    if (size == 2) return is_signed ? ArrayKind::i16 : ArrayKind::u16;
    if (size == 4) return is_signed ? ArrayKind::i32 : ArrayKind::u32;
    if (size == 8) return is_signed ? ArrayKind::i64 : ArrayKind::u64;
  }
  is_known = false;
  return ArrayKind::u8;
}

hid_t memory_type(ArrayKind kind) {
  switch (kind) {
    case ArrayKind::u8:
      return H5T_NATIVE_UINT8;
    case ArrayKind::i8:
      return H5T_NATIVE_INT8;
    case ArrayKind::u16:
      return H5T_NATIVE_UINT16;
    case ArrayKind::i16:
      return H5T_NATIVE_INT16;
    case ArrayKind::u32:
      return H5T_NATIVE_UINT32;
    case ArrayKind::i32:
      return H5T_NATIVE_INT32;
    case ArrayKind::u64:
      return H5T_NATIVE_UINT64;
    case ArrayKind::i64:
      return H5T_NATIVE_INT64;
    case ArrayKind::f32:
      return H5T_NATIVE_FLOAT;
    default:
      return H5T_NATIVE_DOUBLE;
  }
}

/// Texts of a dataset or an attribute, whose `read` takes a type in memory and room. Empty where they cannot
/// be read.
template <typename Read>
std::vector<std::string> hdf5_texts(hid_t type, hid_t space, std::size_t count, const Read& read) {
  std::vector<std::string> texts;
  if (H5Tis_variable_str(type) > 0) {
    const Handle memory(H5Tcopy(type), H5Tclose);
    std::vector<char*> words(count, nullptr);
    if (!memory.is_open() || read(memory, words.data()) < 0) return texts;
    for (const char* word : words)
      texts.emplace_back(word == nullptr ? "" : std::string(word, ::strnlen(word, kMaxTextBytesOfOne)));
    H5Dvlen_reclaim(memory, space, H5P_DEFAULT, words.data());
    return texts;
  }
  const std::size_t size = H5Tget_size(type);
  if (size == 0 || size > kMaxTextBytesOfOne || count > kMaxWordBytes / size) return texts;
  std::string all(size * count, '\0');
  if (read(type, all.data()) < 0) return texts;
  for (std::size_t i = 0; i < count; ++i) {
    std::string text = all.substr(i * size, size);
    text.resize(std::min(text.size(), text.find('\0')));
    texts.push_back(std::move(text));
  }
  return texts;
}

/// An attribute of one number or text; nothing of any other.
bool value_of_attribute(hid_t attribute, std::string& value) {
  const Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  if (!type.is_open() || !space.is_open() || H5Sget_simple_extent_npoints(space) != 1) return false;
  bool is_known = false;
  const ArrayKind kind = array_kind_of(type, is_known);
  if (!is_known) return false;
  if (kind == ArrayKind::text) {
    const std::vector<std::string> texts =
        hdf5_texts(type, space, 1, [&](hid_t memory, void* to) { return H5Aread(attribute, memory, to); });
    if (texts.size() == 1) value = texts[0];
    return texts.size() == 1;
  }
  double number = 0.0;
  if (H5Aread(attribute, H5T_NATIVE_DOUBLE, &number) < 0) return false;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.15g", number);
  value = text.data();
  return true;
}

struct Listing {
  std::vector<StoredArray> arrays;
  std::map<std::string, ArrayWords> words;
  std::size_t word_bytes = 0;
  bool is_too_much = false;
};

struct WordsOfObject {
  Listing& listing;
  ArrayWords words;
};

herr_t take_attribute(hid_t object, const char* name, const H5A_info_t*, void* data) {
  auto& taken = *static_cast<WordsOfObject*>(data);
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  std::string value;
  if (!attribute.is_open() || !value_of_attribute(attribute, value)) return 0;
  taken.listing.word_bytes += std::strlen(name) + value.size();
  taken.listing.is_too_much = taken.listing.word_bytes > kMaxWordBytes;
  if (taken.listing.is_too_much) return 1;
  taken.words.emplace_back(name, std::move(value));
  return 0;
}

ArrayWords words_of_object(hid_t object, Listing& listing) {
  WordsOfObject taken{listing, {}};
  hsize_t first = 0;
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_NATIVE, &first, take_attribute, &taken);
  return std::move(taken.words);
}

/// True if the numbers are in the file itself, in chunks for which there is room.
bool is_within_reach(hid_t dataset, std::size_t size) {
  const Handle made(H5Dget_create_plist(dataset), H5Pclose);
  if (!made.is_open() || H5Pget_external_count(made) > 0) return false;
  const H5D_layout_t layout = H5Pget_layout(made);
  if (layout == H5D_COMPACT || layout == H5D_CONTIGUOUS) return true;
  if (layout != H5D_CHUNKED) return false;
  std::array<hsize_t, kMaxArrayDims> chunk{};
  const int dims = H5Pget_chunk(made, kMaxArrayDims, chunk.data());
  if (dims < 1 || dims > static_cast<int>(kMaxArrayDims)) return false;
  hsize_t room = kMaxChunkBytes / std::max<std::size_t>(1, size);
  for (int d = 0; d < dims; ++d) {
    if (chunk[d] == 0 || chunk[d] > room) return false;
    room /= chunk[d];
  }
  return true;
}

/// The columns of a table of records that are numbers.
void take_columns(hid_t type, const StoredArray& table, Listing& listing) {
  const int columns = H5Tget_nmembers(type);
  for (int c = 0; c < columns && listing.arrays.size() <= kMaxArrays; ++c) {
    const Handle member(H5Tget_member_type(type, static_cast<unsigned>(c)), H5Tclose);
    char* const name = H5Tget_member_name(type, static_cast<unsigned>(c));
    StoredArray column = table;
    bool is_known = false;
    if (name != nullptr && member.is_open()) column.kind = array_kind_of(member, is_known);
    if (is_known && column.kind != ArrayKind::text) {
      column.name += "/" + std::string(name, ::strnlen(name, kMaxTextBytesOfOne));
      listing.arrays.push_back(std::move(column));
    }
    H5free_memory(name);
  }
}

void take_dataset(hid_t dataset, const std::string& name, Listing& listing) {
  const Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  if (!type.is_open() || !space.is_open() || H5Sget_simple_extent_type(space) == H5S_NULL) return;
  StoredArray array;
  array.name = name;
  bool is_known = false;
  array.kind = array_kind_of(type, is_known);
  const int dims = H5Sget_simple_extent_ndims(space);
  const bool is_table = H5Tget_class(type) == H5T_COMPOUND && dims == 1;
  if (!(is_known || is_table) || dims < 0 || dims > static_cast<int>(kMaxArrayDims)) return;
  if (!is_within_reach(dataset, H5Tget_size(type))) return;
  std::array<hsize_t, kMaxArrayDims> lengths{};
  H5Sget_simple_extent_dims(space, lengths.data(), nullptr);
  array.dims.assign(lengths.begin(), lengths.begin() + dims);
  if (is_table) return take_columns(type, array, listing);
  array.words = words_of_object(dataset, listing);
  listing.arrays.push_back(std::move(array));
}

herr_t take_object(hid_t file, const char* name, const H5O_info_t* info, void* data) {
  auto& listing = *static_cast<Listing*>(data);
  // MATLAB's own, which its structures and cells point to.
  if (name[0] == '#') return 0;
  if (info->type == H5O_TYPE_DATASET) {
    const Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
    if (dataset.is_open()) take_dataset(dataset, name, listing);
  } else if (info->type == H5O_TYPE_GROUP) {
    const Handle group(H5Gopen2(file, name, H5P_DEFAULT), H5Gclose);
    if (group.is_open()) {
      ArrayWords words = words_of_object(group, listing);
      if (!words.empty()) listing.words[std::strcmp(name, ".") == 0 ? "" : name] = std::move(words);
    }
  }
  if (listing.arrays.size() + listing.words.size() > kMaxArrays) listing.is_too_much = true;
  return listing.is_too_much ? 1 : 0;
}

/// The file as the library reads it, in the child process.
class Hdf5File : public ArrayFile {
 public:
  Hdf5File(const std::string& name, std::string_view bytes)
      : ArrayFile(name, "HDF5"), file_(open(name, bytes), H5Fclose) {
    if (!file_.is_open()) throw unreadable(name_, "the file is truncated, or no HDF5 file").hint(kCopyAgain);
    Listing listing;
    if (H5Ovisit2(file_, H5_INDEX_NAME, H5_ITER_INC, take_object, &listing, H5O_INFO_BASIC) < 0)
      throw damaged(name_, "what it holds cannot be listed");
    if (listing.is_too_much)
      throw unreadable(name_, "it holds too much")
          .expected(std::to_string(kMaxArrays) + " arrays and groups, and words of " +
                    std::to_string(kMaxWordBytes >> 20) + " MB");
    arrays_ = std::move(listing.arrays);
    words_ = std::move(listing.words);
    take_matlab_words();
  }

  std::vector<std::string> read_texts(const StoredArray& array) override {
    const Handle dataset = opened(array);
    const Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
    if (!type.is_open() || !space.is_open()) throw bad_array(array);
    constexpr std::uint64_t kMaxTexts = 1 << 20;
    if (array.count() > kMaxTexts)
      throw unreadable(name_, "of '" + array.name + "' there are too many texts");
    std::vector<std::string> texts = hdf5_texts(
        type, space, static_cast<std::size_t>(array.count()),
        [&](hid_t memory, void* to) { return H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, to); });
    if (texts.size() != array.count()) throw bad_array(array);
    return texts;
  }

 private:
  static hid_t open(const std::string& name, std::string_view bytes) {
    // In a process of its own: nobody else sees these settings.
    ::setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    H5PLset_loading_state(0);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    if (bytes.data() == nullptr) return H5Fopen(name.c_str(), H5F_ACC_RDONLY, access);
    constexpr std::size_t kGrowth = 1 << 16;
    H5Pset_fapl_core(access, kGrowth, 0);
    std::string copy(bytes);
    H5Pset_file_image(access, copy.data(), copy.size());
    return H5Fopen("bytes in memory", H5F_ACC_RDONLY, access);
  }

  /// MATLAB says of each of its arrays what it is; what is not of numbers is left out.
  void take_matlab_words() {
    for (StoredArray& array : arrays_) {
      const auto word = std::find_if(array.words.begin(), array.words.end(),
                                     [](const auto& one) { return one.first == "MATLAB_class"; });
      if (word == array.words.end()) continue;
      format_ = "MATLAB 7.3";
      array.columns_first = true;
      if (word->second == "char" || word->second == "cell" || word->second == "function_handle")
        array.dims.assign(1, 0);
    }
    arrays_.erase(std::remove_if(arrays_.begin(), arrays_.end(),
                                 [](const StoredArray& array) { return array.count() == 0; }),
                  arrays_.end());
  }

  Error bad_array(const StoredArray& array) const {
    return damaged(name_, "'" + array.name + "' cannot be read");
  }

  /// A dataset and, if it is a table of records, which of its columns an array is.
  struct Column {
    std::string dataset, name;
  };
  Column column_of(const StoredArray& array) const {
    const std::size_t slash = array.name.rfind('/');
    if (slash == std::string::npos || H5Lexists(file_, array.name.c_str(), H5P_DEFAULT) > 0)
      return {array.name, {}};
    return {array.name.substr(0, slash), array.name.substr(slash + 1)};
  }

  Handle opened(const StoredArray& array) const {
    return {H5Dopen2(file_, array.name.c_str(), H5P_DEFAULT), H5Dclose};
  }

  std::string read_block(const StoredArray& array, const std::vector<std::uint64_t>& start,
                         const std::vector<std::uint64_t>& count) override {
    const Column column = column_of(array);
    const Handle dataset(H5Dopen2(file_, column.dataset.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle space(dataset.is_open() ? H5Dget_space(dataset) : -1, H5Sclose);
    // In memory a record has the column alone.
    const Handle record(H5Tcreate(H5T_COMPOUND, size_of(array.kind)), H5Tclose);
    if (!space.is_open() || !record.is_open()) throw bad_array(array);
    if (!column.name.empty() && H5Tinsert(record, column.name.c_str(), 0, memory_type(array.kind)) < 0)
      throw bad_array(array);
    const hid_t type = column.name.empty() ? memory_type(array.kind) : static_cast<hid_t>(record);
    std::string block(size_of(array.kind), '\0');
    if (array.dims.empty()) {
      if (H5Dread(dataset, memory_type(array.kind), H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data()) < 0)
        throw bad_array(array);
      return block;
    }
    std::uint64_t numbers = 1;
    for (const std::uint64_t one : count) numbers *= one;
    block.resize(static_cast<std::size_t>(numbers) * block.size());
    const std::vector<hsize_t> first(start.begin(), start.end()), sizes(count.begin(), count.end());
    const Handle memory(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose);
    if (!memory.is_open() ||
        H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, sizes.data(), nullptr) < 0 ||
        H5Dread(dataset, type, memory, space, H5P_DEFAULT, block.data()) < 0)
      throw bad_array(array);
    return block;
  }

  Handle file_;
};

}  // namespace

bool is_hdf5(std::string_view beginning) {
  constexpr std::string_view kHdf5("\x89HDF\r\n\x1a\n", 8);
  // MATLAB's files of version 7.3 are HDF5 behind a header of 512 bytes.
  constexpr std::size_t kUserBlock = 512;
  return beginning.substr(0, kHdf5.size()) == kHdf5 ||
         (beginning.size() >= kUserBlock && beginning.substr(kUserBlock, kHdf5.size()) == kHdf5);
}

std::unique_ptr<ArrayFile> open_hdf5(const std::string& name, std::string_view bytes) {
  return guarded(name, "HDF5", "HDF5", [name, bytes]() -> std::unique_ptr<ArrayFile> {
    return std::make_unique<Hdf5File>(name, bytes);
  });
}

}  // namespace vegard::sim
