// Small grids to begin with, as the simulator writes them.
#include <fstream>
#include <iterator>

#include "sim/base/grid/vdb_io.h"
#include "sim/base/grid/volumegrid_text.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/target.h"

namespace vegard::tests {
namespace {

/// A few voxels in two bricks; `full`: the second brick holds one number all over.
sim::SparseGrid few_voxels(const std::vector<std::string>& names, bool full) {
  sim::SparseGrid grid;
  grid.voxel = 0.5;
  grid.origin = {3.0, -2.0, 90.0};
  for (const std::string& name : names) grid.channels.push_back({name, "photons cm^-3 s^-1"});
  for (std::size_t c = 0; c < names.size(); ++c) {
    const std::size_t first = c * sim::SparseGrid::kVoxels;
    for (int i = 0; i < 40; ++i) grid.brick({0, 0, 0})[first + i * i % 512] = 1.0f + static_cast<float>(i);
    for (int v = 0; full && v < sim::SparseGrid::kVoxels; ++v) grid.brick({1, 0, -1})[first + v] = 2.5f;
  }
  return grid;
}

std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

std::vector<std::string> fuzz_seeds(const std::string&) {
  const InputFile folder("", "none");
  std::vector<std::string> seeds;
  const std::vector<std::vector<std::string>> channels = {
      {"emission_5577"}, {"density"}, {"density", "emission_5577", "emission_6300"}};
  for (const auto& names : channels)
    for (const bool full : {false, true}) {
      sim::VdbOptions options;
      options.overwrite = true;
      options.centre_index = full ? 0.0 : 0.5;
      sim::VdbMetadata metadata;
      if (full) metadata.texts["frame"] = "sun";
      metadata.numbers[full ? "unit_km" : "site_latitude_deg"] = full ? 696000.0 : 65.0;
      sim::write_vdb(folder.path("a.vdb"), few_voxels(names, full), metadata, options);
      seeds.push_back(bytes_of(folder.path("a.vdb")));
    }
  sim::VolumegridOptions options;
  options.colours["Le"] = {1.0, 0.5, 0.25};
  sim::write_volumegrid(folder.path("a.pbrt"), few_voxels({"density"}, false), 0, options);
  seeds.push_back(bytes_of(folder.path("a.pbrt")));
  seeds.push_back(
      "# pbrt\nWorldBegin\nVolume \"volumegrid\" \"integer nx\" [2] \"integer ny\" 1 \"integer nz\" [ 2 ]\n"
      "\"point p0\" [-1 0 -1e0] \"point p1\" [1 1 1] \"color sigma_a\" [.1 .2 .3]\n"
      "\"float density\" [0 .5\n1e-3 +2]\nWorldEnd\n");
  seeds.push_back(
      "Volume \"volumegrid\" \"float density\" [1 2 3 4 5 6 7 8] \"integer nx\" 2 \"integer ny\" 2 "
      "\"integer nz\" 2");
  return seeds;
}

std::vector<std::string> fuzz_dictionary() {
  std::vector<std::string> words = {"\"integer nx\" ",
                                    "\"integer ny\" ",
                                    "\"point p0\" ",
                                    "\"point p1\" ",
                                    "\"float density\" ",
                                    "\"color Le\" ",
                                    "[",
                                    "]",
                                    "65536",
                                    "1e12",
                                    "Volume \"volumegrid\" "};
  for (const char* text : {"Tree_float_5_4_3",
                           "Tree_float_5_4_3_HalfFloat",
                           "Tree_int32_5_4_3",
                           "emission_5577",
                           "emission_6300",
                           "density",
                           "UniformScaleTranslateMap",
                           "AffineMap",
                           "NonlinearFrustumMap",
                           "UnitaryMap",
                           "frame",
                           "sun",
                           "unit_km",
                           "unit_cm",
                           "voxel_centre_index",
                           "class",
                           "level set",
                           "fog volume",
                           "string",
                           "double",
                           "float",
                           "is_saved_as_half_float",
                           "file_bbox_min"})
    words.push_back(text);
  // Lengths before such words: little-endian, 32 bits.
  for (const int length : {0, 1, 3, 16, 255})
    words.push_back(std::string(1, static_cast<char>(length)) + std::string(3, '\0'));
  return words;
}

void mend_after_mutation(std::string&) {}

}  // namespace vegard::tests
