// Reads MATLAB files of version 5 (also called 6 and 7; those of 7.3 are HDF5) with libmatio. Only
// mat_file.cpp includes the library, which runs in a separate process (sim/base/file/child_worker.h).
//
// It reads arrays of real numbers, also in structures with one element, such as "skymap/full_azimuth".
#include "sim/base/array/array_format.h"

#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <utility>

#include "sim/base/error.h"

namespace vegard::sim {
namespace {

constexpr int kMaxVariables = 10000;
constexpr int kDeepestStructure = 3;
struct CloseMat {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using OpenMat = std::unique_ptr<mat_t, CloseMat>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

/// Finds the kind of numbers of a class of real numbers; false for all other classes.
bool kind_of_class(const matvar_t& variable, ArrayKind& kind) {
  if (variable.isComplex != 0) return false;
  switch (variable.class_type) {
    case MAT_C_UINT8:
      kind = ArrayKind::u8;
      return true;
    case MAT_C_INT8:
      kind = ArrayKind::i8;
      return true;
    case MAT_C_UINT16:
      kind = ArrayKind::u16;
      return true;
    case MAT_C_INT16:
      kind = ArrayKind::i16;
      return true;
    case MAT_C_UINT32:
      kind = ArrayKind::u32;
      return true;
    case MAT_C_INT32:
      kind = ArrayKind::i32;
      return true;
    case MAT_C_UINT64:
      kind = ArrayKind::u64;
      return true;
    case MAT_C_INT64:
      kind = ArrayKind::i64;
      return true;
    case MAT_C_SINGLE:
      kind = ArrayKind::f32;
      return true;
    case MAT_C_DOUBLE:
      kind = ArrayKind::f64;
      return true;
    default:
      return false;
  }
}

/// The library opens files by name alone: bytes become one that has none, in memory.
std::string file_of_bytes(std::string_view bytes) {
  const int descriptor = ::memfd_create("mat", 0);
  if (descriptor < 0) return {};
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written <= 0) return {};
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return "/proc/self/fd/" + std::to_string(descriptor);
}

/// True if the elements of a file of version 5 end where the file ends. It has a header of 128 bytes, and
/// elements one after another, each a type and a size in four bytes before its data (or both in four bytes
/// and the data in the other four), to a multiple of eight unless they are packed (MathWorks, "MAT-File
/// Format", Level 5). The library takes what is cut off for variables that are not there.
bool has_whole_elements(const std::string& place) {
  constexpr std::uint64_t kHeader = 128, kTag = 8, kEndianAt = 126;
  constexpr std::uint32_t kPacked = 15, kSmall = 0xffff0000u;
  std::ifstream stream(place, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(stream.tellg(), 0));
  char endian[2] = {};
  stream.seekg(kEndianAt);
  stream.read(endian, sizeof endian);
  const bool is_little = endian[0] == 'I';
  const auto word = [&](const char* bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[is_little ? 3 - i : i]);
    return value;
  };
  std::uint64_t at = kHeader;
  while (at + kTag <= size) {
    char tag[kTag] = {};
    stream.seekg(static_cast<std::streamoff>(at));
    if (!stream.read(tag, sizeof tag)) return false;
    at += kTag;
    if ((word(tag) & kSmall) != 0) continue;
    const std::uint64_t bytes = word(tag + 4);
    at += word(tag) == kPacked ? bytes : (bytes + kTag - 1) / kTag * kTag;
  }
  return at == size;
}

/// The file as the library reads it, in the child process, which ends without closing it.
class MatFile : public ArrayFile {
 public:
  MatFile(const std::string& name, std::string_view bytes)
      : ArrayFile(name, "MATLAB"), place_(bytes.data() != nullptr ? file_of_bytes(bytes) : name) {
    const OpenMat file = opened();
    if (Mat_GetVersion(file.get()) == MAT_FT_MAT5 && !has_whole_elements(place_))
      throw truncated(name_, "its elements end behind its end");
    for (int variables = 0;; ++variables) {
      if (variables == kMaxVariables)
        throw unreadable(name_, "it holds more than " + std::to_string(kMaxVariables) + " variables");
      const Variable variable(Mat_VarReadNextInfo(file.get()));
      if (variable == nullptr) break;
      if (variable->name == nullptr) continue;
      if (variable->class_type == MAT_C_STRUCT)
        take_structure(variable->name);
      else
        take(*variable, variable->name);
    }
    if (arrays_.empty())
      throw unreadable(name_,
                       "no array of real numbers can be read of it: the file is damaged, or holds none")
          .hint(kCopyAgain);
  }

 private:
  OpenMat opened() const {
    OpenMat file(Mat_Open(place_.c_str(), MAT_ACC_RDONLY));
    if (file == nullptr) throw unreadable(name_, "the file is truncated, or no MATLAB file").hint(kCopyAgain);
    return file;
  }

  void take(const matvar_t& variable, const std::string& name) {
    StoredArray array;
    array.name = name;
    if (!kind_of_class(variable, array.kind) || variable.rank < 1 ||
        variable.rank > static_cast<int>(kMaxArrayDims) || variable.dims == nullptr)
      return;
    array.dims.assign(variable.dims, variable.dims + variable.rank);
    std::reverse(array.dims.begin(), array.dims.end());
    array.columns_first = true;
    if (array.count() > 0 && arrays_.size() < kMaxArrays) arrays_.push_back(std::move(array));
  }

  void take_fields(const matvar_t& structure, const std::string& name, int depth) {
    const bool is_one =
        structure.rank == 2 && structure.dims != nullptr && structure.dims[0] == 1 && structure.dims[1] == 1;
    if (!is_one || depth > kDeepestStructure) return;
    const unsigned fields = Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&structure));
    char* const* names = Mat_VarGetStructFieldnames(&structure);
    for (unsigned i = 0; names != nullptr && i < fields; ++i) {
      const matvar_t* field = Mat_VarGetStructFieldByIndex(const_cast<matvar_t*>(&structure), i, 0);
      if (field == nullptr || names[i] == nullptr) continue;
      const std::string path = name + "/" + names[i];
      if (field->class_type == MAT_C_STRUCT)
        take_fields(*field, path, depth + 1);
      else
        take(*field, path);
    }
  }

  void take_structure(const std::string& name) {
    const Variable structure(Mat_VarRead(opened().get(), name.c_str()));
    if (structure != nullptr) take_fields(*structure, name, 1);
  }

  /// The variable or field of that name in `variable_`, which is kept for the next block of it.
  const matvar_t* find(const std::string& path) {
    const std::string name = path.substr(0, path.find('/'));
    if (variable_ == nullptr || variable_name_ != name) {
      variable_.reset();
      variable_.reset(Mat_VarRead(opened().get(), name.c_str()));
      variable_name_ = name;
    }
    const matvar_t* found = variable_.get();
    for (std::size_t at = path.find('/'); found != nullptr && at != std::string::npos;) {
      const std::size_t next = path.find('/', at + 1);
      const std::string field = path.substr(at + 1, next == std::string::npos ? next : next - at - 1);
      found = Mat_VarGetStructFieldByName(const_cast<matvar_t*>(found), field.c_str(), 0);
      at = next;
    }
    return found;
  }

  std::string read_block(const StoredArray& array, const std::vector<std::uint64_t>& start,
                         const std::vector<std::uint64_t>& count) override {
    const matvar_t* found = find(array.name);
    const std::uint64_t bytes = array.count() * size_of(array.kind);
    if (found == nullptr || found->data == nullptr || found->nbytes < bytes)
      throw damaged(name_, "'" + array.name + "' cannot be read");
    return block_of({static_cast<const char*>(found->data), static_cast<std::size_t>(bytes)}, array, start,
                    count);
  }

  std::string place_;
  Variable variable_;
  std::string variable_name_;
};

}  // namespace

bool is_mat(std::string_view beginning) {
  constexpr std::string_view kMat = "MATLAB 5.0 MAT-file";
  return beginning.substr(0, kMat.size()) == kMat;
}

std::unique_ptr<ArrayFile> open_mat(const std::string& name, std::string_view bytes) {
  return guarded(name, "MATLAB", "the reader of MATLAB files", [name, bytes]() -> std::unique_ptr<ArrayFile> {
    return std::make_unique<MatFile>(name, bytes);
  });
}

}  // namespace vegard::sim
