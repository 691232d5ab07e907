// Files of arrays by other writers (tests/data/imagers/make.py): what is in them, and what is made of damage.
#include "sim/base/array/array_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "sim/base/array/array_format.h"
#include "sim/base/error.h"
#include "tests/support/expect_error.h"
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::array_file_test {
namespace {

using tests::expect_words;

std::string made(const std::string& name) { return tests::source_folder() + "/tests/data/imagers/" + name; }

const StoredArray& array_called(const ArrayFile& file, const std::string& name) {
  const auto found = std::find_if(file.arrays().begin(), file.arrays().end(),
                                  [&](const StoredArray& array) { return array.name == name; });
  if (found == file.arrays().end()) throw std::runtime_error("no array " + name);
  return *found;
}

using Dims = std::vector<std::uint64_t>;

TEST(ArrayFile, ReadsHdf5) {
  const auto file = open_array_file(made("rgb.h5"));
  EXPECT_STREQ(file->format(), "HDF5");
  const StoredArray& images = array_called(*file, "data/images");
  EXPECT_EQ(images.dims, (Dims{4, 5, 3, 3}));
  EXPECT_EQ(images.kind, ArrayKind::u8);
  EXPECT_FALSE(images.columns_first);
  const std::string block = file->read(images, {2, 1, 0, 1}, {2, 3, 3, 1});
  ASSERT_EQ(block.size(), 18u);
  // Row 2, column 1, second colour, and the last of the block: row 3, column 3, third colour.
  EXPECT_EQ(number_of(block, images.kind, 1), 100 + 20 + 1 + 40);
  EXPECT_EQ(number_of(block, images.kind, 17), 100 + 30 + 3 + 80);
  const StoredArray& times = array_called(*file, "data/timestamp");
  EXPECT_EQ(times.kind, ArrayKind::text);
  EXPECT_EQ(file->read_texts(times).at(2), "2021-10-30 06:05:06.250000 UTC");
  const ArrayWords& words = file->words().at("metadata/file");
  EXPECT_NE(std::find(words.begin(), words.end(), ArrayWords::value_type("imager_unique_id", "rgb-04")),
            words.end());
  EXPECT_NE(std::find(words.begin(), words.end(), ArrayWords::value_type("site_unique_id", "gill")),
            words.end());
}

// Each column of numbers of a table of records is an array; columns of text are none.
TEST(ArrayFile, ReadsTablesOfHdf5) {
  const auto file = open_array_file(made("madrigal.h5"));
  EXPECT_EQ(file->arrays().size(), 8u);
  const StoredArray& beams = array_called(*file, "Data/Table Layout/beamid");
  EXPECT_EQ(beams.dims, (Dims{56}));
  EXPECT_EQ(beams.kind, ArrayKind::i32);
  const std::vector<double> altitudes = file->read_numbers(array_called(*file, "Data/Table Layout/gdalt"));
  for (std::size_t row = 0; row < altitudes.size(); ++row)
    EXPECT_EQ(altitudes[row], 85.0 + 5.0 * static_cast<double>(row % 14));
  EXPECT_EQ(file->read(beams, {13}, {2}), std::string("\1\0\0\0\2\0\0\0", 8));
}

TEST(ArrayFile, ReadsMatlabOfBothKinds) {
  for (const char* name : {"stack.mat", "stack_v73.mat"}) {
    const auto file = open_array_file(made(name));
    const StoredArray& images = array_called(*file, "images");
    EXPECT_EQ(images.dims, (Dims{3, 5, 4})) << name;
    EXPECT_TRUE(images.columns_first);
    const std::string block = file->read(images, {2, 1, 0}, {1, 2, 4});
    for (int x = 1; x < 3; ++x)
      for (int y = 0; y < 4; ++y)
        EXPECT_EQ(number_of(block, images.kind, (x - 1) * 4 + y), 200 + 10 * y + x) << name;
  }
  const auto file = open_array_file(made("stack.mat"));
  EXPECT_EQ(file->read_numbers(array_called(*file, "sky/azimuth")).at(5), 11.0);
  EXPECT_STREQ(open_array_file(made("stack_v73.mat"))->format(), "MATLAB 7.3");
}

TEST(ArrayFile, ReadsCdf) {
  for (const char* name : {"asi.cdf", "asi_packed.cdf"}) {
    const auto file = open_array_file(made(name));
    const StoredArray& images = array_called(*file, "thg_asf_gill");
    EXPECT_EQ(images.dims, (Dims{3, 4, 5})) << name;
    EXPECT_EQ(images.kind, ArrayKind::u16);
    const std::string block = file->read(images, {1, 2, 0}, {2, 1, 5});
    for (int f = 0; f < 2; ++f)
      for (int x = 0; x < 5; ++x)
        EXPECT_EQ(number_of(block, images.kind, 5 * f + x), 100 * (f + 1) + 20 + x) << name;
    const StoredArray& epochs = array_called(*file, "thg_asf_gill_epoch");
    EXPECT_EQ(epochs.clock, ArrayClock::cdf_epoch);
    EXPECT_EQ(file->read_numbers(epochs).at(1), 63802793103250.0);
  }
}

TEST(ArrayFile, ReadsIdlSaves) {
  for (const char* name : {"skymap.sav", "skymap_packed.sav"}) {
    const auto file = open_array_file(made(name));
    const StoredArray& azimuth = array_called(*file, "skymap/full_azimuth");
    EXPECT_EQ(azimuth.dims, (Dims{4, 6})) << name;
    EXPECT_EQ(file->read_numbers(azimuth).at(6 * 3 + 5), 35.0);
    EXPECT_EQ(file->read_numbers(array_called(*file, "skymap/full_elevation")).at(6), 25.0);
    EXPECT_EQ(file->read_numbers(array_called(*file, "skymap/full_row")), std::vector<double>(24, 3.0));
    EXPECT_EQ(file->read_numbers(array_called(*file, "skymap/full_ignore")), std::vector<double>(5, 1.0));
    EXPECT_EQ(file->read_numbers(array_called(*file, "skymap/site_map_longitude")).at(0), 265.25);
    EXPECT_EQ(file->read_numbers(array_called(*file, "skymap/generation_info/n")).at(0), 7.0);
    EXPECT_EQ(file->words().at("skymap/generation_info").at(0).second, "a script");
  }
}

TEST(ArrayFile, CutsBlocksOutOfAnArray) {
  StoredArray array;
  array.dims = {2, 3, 4};
  std::string all(24, '\0');
  std::iota(all.begin(), all.end(), '\0');
  EXPECT_EQ(block_of(all, array, {1, 1, 2}, {1, 2, 2}), std::string("\x12\x13\x16\x17", 4));
  EXPECT_EQ(block_of(all, array, {0, 0, 0}, {2, 3, 4}), all);
}

/// All numbers and texts of a file, by the names of their arrays.
std::map<std::string, std::string> contents_of(ArrayFile& file) {
  std::map<std::string, std::string> contents;
  for (const StoredArray& array : file.arrays()) {
    std::string& content = contents[array.name];
    if (array.kind == ArrayKind::text) {
      for (const std::string& text : file.read_texts(array)) content += text + '\n';
    } else {
      content = file.read(array);
    }
  }
  return contents;
}

/// Whether damaged bytes are refused, in one message of one line that names them. Where they are not, what
/// is read of them must be what the sound file has: nothing is made up, and nothing left out.
bool is_refused(const std::string& bytes, const std::string& name,
                const std::map<std::string, std::string>& sound, const tests::TemporaryFolder* folder) {
  try {
    if (folder != nullptr) tests::put(*folder / name, bytes);
    const auto file =
        folder != nullptr ? open_array_file(*folder / name) : open_array_file(name, std::string_view(bytes));
    EXPECT_EQ(contents_of(*file), sound) << name << " of " << bytes.size() << " bytes";
    return false;
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_EQ(error.kind(), ErrorKind::unreadable_input) << text;
    EXPECT_NE(text.find(name), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return true;
  }
}

TEST(ArrayFile, GivesOneMessageForWhatIsCutShort) {
  const tests::TemporaryFolder folder;
  const std::vector<const tests::TemporaryFolder*> places = {&folder, nullptr};
  struct Cut {
    const char* name;
    int parts;       ///< how many cuts, evenly
    int least_told;  ///< of them, in hundredths: behind the last number there may be something nobody misses
  };
  // Our own readers are asked of every few bytes; the libraries' start a process each time. Behind the last
  // record of skymap_packed.sav, at 602 of 1295 bytes, GDL has left what was there before.
  for (const Cut& cut : {Cut{"rgb.h5", 10, 100}, Cut{"stack.mat", 20, 100}, Cut{"stack_v73.mat", 10, 100},
                         Cut{"asi.cdf", 200, 95}, Cut{"asi_packed.cdf", 200, 95}, Cut{"skymap.sav", 200, 95},
                         Cut{"skymap_packed.sav", 200, 45}}) {
    SCOPED_TRACE(cut.name);
    const std::string whole = tests::bytes_of(made(cut.name));
    const std::map<std::string, std::string> sound = contents_of(*open_array_file(made(cut.name)));
    ASSERT_GE(sound.size(), 1u);
    int cuts = 0, refused = 0;
    for (int part = 1; part < cut.parts; ++part) {
      const std::string bytes = whole.substr(0, whole.size() * part / cut.parts);
      if (array_format(bytes) == nullptr) continue;  // too little to be known for what it was
      for (const tests::TemporaryFolder* where : places) {
        ++cuts;
        refused += is_refused(bytes, std::string("cut_") + cut.name, sound, where) ? 1 : 0;
      }
    }
    EXPECT_GT(cuts, cut.parts);
    EXPECT_GE(100 * refused, cut.least_told * cuts) << refused << " of " << cuts;
  }
  const std::string sav = tests::bytes_of(made("skymap.sav"));
  expect_words(ErrorKind::unreadable_input, {"it", "truncated"},
               [&] { open_array_file("it", std::string_view(sav).substr(0, sav.size() / 2)); });
  const std::string cdf = tests::bytes_of(made("asi.cdf"));
  expect_words(ErrorKind::unreadable_input, {"it", "behind its end"},
               [&] { open_array_file("it", std::string_view(cdf).substr(0, cdf.size() / 2)); });
}

TEST(ArrayFile, RefusesWhatItDoesNotRead) {
  std::string old = tests::bytes_of(made("asi.cdf"));
  old[1] = '\xF2';
  old[2] = '\x60';
  old[3] = '\x02';
  EXPECT_TRUE(is_cdf(old));
  expect_words(ErrorKind::unreadable_input, {"it", "version 2", "version 3"},
               [&] { open_array_file("it", old); });
  std::string vax = tests::bytes_of(made("asi.cdf"));
  vax[8 + 12 + 8 + 8 + 3] = '\3';  // the encoding of CDF's first record
  expect_words(ErrorKind::unreadable_input, {"it", "encoded"}, [&] { open_array_file("it", vax); });
  expect_words(ErrorKind::unreadable_input, {"it", "arrays"}, [&] { open_array_file("it", "something"); });
}

TEST(ArrayFile, MakesNoRoomForWhatIsOnlyDeclared) {
  const auto huge = open_array_file(made("huge.h5"));
  const StoredArray& images = array_called(*huge, "images");
  EXPECT_EQ(images.count(), 1600000000000u);
  expect_words(ErrorKind::unreadable_input, {"huge.h5", "at once"}, [&] { huge->read(images); });
  // Of a chunk that large there is nothing to be had.
  EXPECT_TRUE(open_array_file(made("huge_chunk.h5"))->arrays().empty());
}

}  // namespace
}  // namespace vegard::sim::array_file_test
