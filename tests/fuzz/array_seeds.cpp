// Files of arrays and a tar by other writers (tests/data/imagers/make.py), and films of 32 x 24 pixels by
// FFmpeg (tests/support/frames/made_video.h).
#include <fstream>
#include <iterator>

#include "tests/fuzz/target.h"

namespace vegard::tests {

std::vector<std::string> fuzz_seeds(const std::string& source) {
  std::vector<std::string> seeds;
  for (const char* name :
       {"asi.cdf", "asi_packed.cdf", "skymap.sav", "skymap_packed.sav", "minute.png.tar", "rgb.h5", "huge.h5",
        "stack.mat", "stack_v73.mat", "film.mp4", "film.avi", "film.mkv"}) {
    std::ifstream stream(source + "/tests/data/imagers/" + name, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return seeds;
}

std::vector<std::string> fuzz_dictionary() {
  return {"\xff\xff\xff\xff", std::string(8, '\0'), "azimuth", "elevation", "time"};
}

void mend_after_mutation(std::string&) {}

}  // namespace vegard::tests
