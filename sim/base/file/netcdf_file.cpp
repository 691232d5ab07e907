#include "sim/base/file/netcdf_file.h"

#include <netcdf.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <optional>

#include "sim/base/error.h"

/// Of HDF5, under netCDF: the library closes no files at the process's end.
extern "C" int H5dont_atexit(void);

namespace vegard::sim {
namespace {

nc_type library_type(NetcdfType type) {
  switch (type) {
    case NetcdfType::real:
      return NC_DOUBLE;
    case NetcdfType::whole:
      return NC_INT;
    case NetcdfType::flag:
      return NC_BYTE;
    case NetcdfType::text:
      return NC_STRING;
  }
  return NC_NAT;
}

/// HDF5 would lock the file for itself, and find it locked already by sim::WholeFile. It looks at the
/// environment alone, when it is used first.
class WithoutLocks {
 public:
  WithoutLocks() {
    const char* before = std::getenv(kName);
    if (before != nullptr) before_ = before;
    ::setenv(kName, "FALSE", 1);
  }
  ~WithoutLocks() {
    if (before_)
      ::setenv(kName, before_->c_str(), 1);
    else
      ::unsetenv(kName);
  }
  WithoutLocks(const WithoutLocks&) = delete;
  WithoutLocks& operator=(const WithoutLocks&) = delete;

 private:
  static constexpr const char* kName = "HDF5_USE_FILE_LOCKING";
  std::optional<std::string> before_;
};

}  // namespace

const double kNetcdfNoReal = NC_FILL_DOUBLE;
static_assert(kNetcdfNoFlag == NC_FILL_BYTE, "the library's own");

NetcdfFile::NetcdfFile(const std::string& file, const std::string& shown_name) : shown_name_(shown_name) {
  // After a write that failed (a full disk), HDF5 ends the process with a segmentation fault when it closes
  // the file: by nc_abort(), or by itself at the process's end.
  static_cast<void>(H5dont_atexit());
  const WithoutLocks without_locks;
  require(nc_create(file.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_));
}

NetcdfFile::~NetcdfFile() {
  if (id_ >= 0 && !has_failed_) nc_abort(id_);
}

void NetcdfFile::require(int code) const {
  if (code == NC_NOERR) return;
  has_failed_ = true;
  throw Error(ErrorKind::unwritable_output, std::string("cannot be written: ") + nc_strerror(code))
      .file(shown_name_)
      .hint("is the disk full?");
}

NetcdfFile::Dimension NetcdfFile::dimension(const std::string& name, std::size_t size) {
  Dimension made;
  require(nc_def_dim(id_, name.c_str(), size, &made.id));
  sizes_.resize(static_cast<std::size_t>(made.id) + 1);
  sizes_[static_cast<std::size_t>(made.id)] = size;
  return made;
}

NetcdfFile::Variable NetcdfFile::variable(const std::string& name, NetcdfType type,
                                          const std::vector<Dimension>& dimensions) {
  Variable made;
  made.type = type;
  std::vector<int> ids;
  for (const Dimension& dimension : dimensions) ids.push_back(dimension.id);
  require(
      nc_def_var(id_, name.c_str(), library_type(type), static_cast<int>(ids.size()), ids.data(), &made.id));
  constexpr int kShuffled = 1, kDeflated = 1, kLevel = 4;
  if (type != NetcdfType::text && !ids.empty())
    require(nc_def_var_deflate(id_, made.id, kShuffled, kDeflated, kLevel));
  if (type == NetcdfType::real)
    require(nc_put_att_double(id_, made.id, _FillValue, NC_DOUBLE, 1, &kNetcdfNoReal));
  const signed char no_flag = kNetcdfNoFlag;
  if (type == NetcdfType::flag) require(nc_put_att_schar(id_, made.id, _FillValue, NC_BYTE, 1, &no_flag));
  dimensions_.resize(static_cast<std::size_t>(made.id) + 1);
  dimensions_[static_cast<std::size_t>(made.id)] = ids;
  return made;
}

void NetcdfFile::attribute(const std::string& name, const std::string& text) {
  require(nc_put_att_text(id_, NC_GLOBAL, name.c_str(), text.size(), text.data()));
}

void NetcdfFile::attribute(const Variable& variable, const std::string& name, const std::string& text) {
  require(nc_put_att_text(id_, variable.id, name.c_str(), text.size(), text.data()));
}

void NetcdfFile::attribute(const Variable& variable, const std::string& name, double value) {
  require(nc_put_att_double(id_, variable.id, name.c_str(), NC_DOUBLE, 1, &value));
}

void NetcdfFile::flags(const Variable& variable, const std::string& name, const std::vector<int>& values) {
  std::vector<signed char> bytes(values.begin(), values.end());
  require(nc_put_att_schar(id_, variable.id, name.c_str(), NC_BYTE, bytes.size(), bytes.data()));
}

void NetcdfFile::end_of_definitions() {
  if (defines_) require(nc_enddef(id_));
  defines_ = false;
}

std::vector<std::size_t> NetcdfFile::counts_of(const Variable& to, std::size_t values) const {
  const std::vector<int>& ids = dimensions_.at(static_cast<std::size_t>(to.id));
  if (ids.size() == 1) return {values};
  std::vector<std::size_t> counts;
  for (const int id : ids) counts.push_back(sizes_.at(static_cast<std::size_t>(id)));
  assert(values == std::accumulate(counts.begin(), counts.end(), std::size_t{1}, std::multiplies<>()));
  return counts;
}

void NetcdfFile::put(const Variable& to, std::size_t first, const std::vector<double>& values) {
  assert(to.type == NetcdfType::real);
  end_of_definitions();
  std::vector<double> filled = values;
  for (double& value : filled)
    if (!std::isfinite(value)) value = kNetcdfNoReal;
  const std::vector<std::size_t> counts = counts_of(to, values.size());
  std::vector<std::size_t> starts(counts.size(), 0);
  if (!starts.empty()) starts[0] = first;
  require(nc_put_vara_double(id_, to.id, starts.data(), counts.data(), filled.data()));
}

void NetcdfFile::put(const Variable& to, std::size_t first, const std::vector<int>& values) {
  assert(to.type == NetcdfType::whole || to.type == NetcdfType::flag);
  end_of_definitions();
  const std::vector<std::size_t> counts = counts_of(to, values.size());
  std::vector<std::size_t> starts(counts.size(), 0);
  if (!starts.empty()) starts[0] = first;
  require(nc_put_vara_int(id_, to.id, starts.data(), counts.data(), values.data()));
}

void NetcdfFile::put(const Variable& to, std::size_t first, const std::vector<std::string>& values) {
  assert(to.type == NetcdfType::text);
  end_of_definitions();
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  const std::vector<std::size_t> counts = counts_of(to, values.size());
  std::vector<std::size_t> starts(counts.size(), 0);
  if (!starts.empty()) starts[0] = first;
  require(nc_put_vara_string(id_, to.id, starts.data(), counts.data(), pointers.data()));
}

void NetcdfFile::close() {
  end_of_definitions();
  const int id = id_;
  id_ = -1;
  require(nc_close(id));
}

std::string netcdf_name(const std::string& words) {
  std::string name;
  for (const char c : words) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (is_plain)
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  const bool begins_well = !name.empty() && !(name[0] >= '0' && name[0] <= '9');
  return begins_well ? name : "n_" + name;
}

}  // namespace vegard::sim
