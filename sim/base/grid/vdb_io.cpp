#include "sim/base/grid/vdb_io.h"

#include <openvdb/version.h>

#include <cerrno>
#include <exception>
#include <fstream>

#include "sim/base/error.h"
#include "sim/base/file/sha256.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/grid/openvdb.h"
#include "sim/base/grid/vdb_outline.h"
#include "sim/base/module.h"
#include "sim/base/quiet_decoder.h"

namespace vegard::sim {
namespace {

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

Error refused(const std::string& path, const VdbProblem& why) {
  return unreadable(path, why.problem).expected(why.expected).hint(why.hint);
}

}  // namespace

void write_vdb(const std::string& path, SparseGrid&& grid, const VdbMetadata& metadata,
               const VdbOptions& options) {
  const OpenVdb& library = module_functions<OpenVdb>();
  WholeFile file(path, options.overwrite);
  if (!library.write(file.temporary(), std::move(grid), metadata, options)) throw unwritable(path, errno);
  try {
    errno = 0;
    name_by_content(file.temporary());
  } catch (const std::exception&) {
    throw unwritable(path, errno);
  }
  file.commit();
}

VdbFile read_vdb(const std::string& path, const std::vector<std::string>& wanted, std::uint64_t max_bytes,
                 std::uint64_t bytes_beside) {
  const VdbOutline outline = vdb_outline(path, wanted);
  VdbProblem problem;
  if (!outline.complaint.empty())
    problem = not_openvdb(outline.complaint);
  else if (outline.tree_bytes > static_cast<double>(max_bytes))
    problem = too_large_grids(outline.tree_bytes, max_bytes);
  if (!problem.problem.empty()) throw refused(path, problem);
  const OpenVdb& library = module_functions<OpenVdb>();
  VdbFile file;
  {
    const QuietDecoder quiet;
    file = library.read(path, wanted, max_bytes, bytes_beside, problem);
  }
  if (!problem.problem.empty()) throw refused(path, problem);
  return file;
}

std::string vdb_library_version() { return OPENVDB_LIBRARY_VERSION_STRING; }

}  // namespace vegard::sim
