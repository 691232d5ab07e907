#include "apps/output/animation/movie.h"

#include <malloc.h>

#include <algorithm>
#include <memory>

#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/module.h"
#include "sim/base/text.h"

namespace vegard::apps {
namespace {

sim::Error trouble(sim::ErrorKind kind, const std::string& file, const std::string& problem,
                   const std::string& hint = {}) {
  return sim::Error(kind, problem).file(file).hint(hint);
}

/// While there is one, memory comes from malloc with zeros in it. libx264 (core 164) reads memory that it has
/// not written where the processor has AVX-512, and what was there before would decide about the movie's
/// bytes.
class ZeroedMemory {
 public:
  ZeroedMemory() { fill(0xff); }  // filled with the complement of that
  ~ZeroedMemory() { fill(0); }    // nothing is filled any more
  ZeroedMemory(const ZeroedMemory&) = delete;
  ZeroedMemory& operator=(const ZeroedMemory&) = delete;

 private:
  static void fill([[maybe_unused]] int with) {
#ifdef M_PERTURB  // glibc's
    ::mallopt(M_PERTURB, with);
#endif
  }
};

}  // namespace

double rate_factor_of(int quality) { return std::max(0.5, 0.5 * (100 - quality)); }

std::optional<MovieKind> movie_kind_of(const std::string& path) {
  const std::string ending = sim::lowered_extension(path);
  if (ending == ".mp4") return MovieKind::mp4;
  if (ending == ".mov") return MovieKind::prores;
  return std::nullopt;
}

std::string write_movie(const std::string& path, const std::vector<std::string>& pictures,
                        double frames_per_second, bool overwrite, const std::function<void(double)>& progress,
                        const std::atomic<bool>* stop, bool all_around, int quality) {
  const MovieModule& module = sim::module_functions<MovieModule>();
  sim::WholeFile file(path, overwrite);
  const ZeroedMemory zeroed;
  const auto check = [](MoviePicture outcome, const std::string& picture) {
    if (outcome == MoviePicture::unreadable)
      throw trouble(sim::ErrorKind::unreadable_input, picture, "cannot be read as a picture",
                    "remove it, and it will be made again");
    if (outcome == MoviePicture::of_other_size)
      throw trouble(sim::ErrorKind::unreadable_input, picture, "has another size or depth than the first frame");
  };
  const std::unique_ptr<MovieWriter> writer = module.writer();
  const MovieKind kind = movie_kind_of(path).value_or(MovieKind::mp4);
  check(writer->open(file.temporary(), kind, pictures.front(), frames_per_second, rate_factor_of(quality)),
        pictures.front());
  const std::string codec = writer->codec();
  if (codec.empty())
    throw trouble(sim::ErrorKind::unwritable_output, path,
                  "cannot be encoded: no codec of FFmpeg takes such a movie",
                  "write frames, and encode them with another program");
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (stop != nullptr && stop->load()) return {};
    check(writer->write(pictures[i]), pictures[i]);
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(pictures.size()));
  }
  writer->finish();
  if (all_around && kind == MovieKind::mp4) mark_as_spherical(file.temporary(), path);
  if (!writer->is_whole(pictures.size()))
    throw trouble(sim::ErrorKind::unwritable_output, path,
                  "cannot be written: what was encoded cannot be read again",
                  "is the disk full? The frames are still there");
  file.commit();
  return codec;
}

}  // namespace vegard::apps
