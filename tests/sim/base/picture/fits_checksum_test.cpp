#include "sim/base/picture/fits_checksum.h"

#include <fitsio.h>
#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/base/picture/fits_io.h"
#include "tests/support/fits_bytes.h"

namespace vegard::sim::fits_checksum_test {
namespace {

Image picture() {
  Image image(40, 31, {"Y"});
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = 0.5f * static_cast<float>(i * i % 977);
  return image;
}

// CFITSIO, which knows nothing of this code, finds every part sound: 1 for each sum.
TEST(FitsChecksum, IsWhatOtherProgramsCheck) {
  for (std::string bytes : {encode_fits(picture(), {{"DATE-OBS", "2015-10-07T08:23:51", "it began then"}}),
                            encode_fits_header({{"CRVAL1", 12.5, ""}}),
                            encode_fits_table({{"x", "px", {1.0, 2.5}}, {"y", "px", {-3.0, 1e9}}}, {})}) {
    void* buffer = bytes.data();
    std::size_t size = bytes.size();
    fitsfile* file = nullptr;
    int status = 0, parts = 0;
    fits_open_memfile(&file, "a.fits", READONLY, &buffer, &size, 0, nullptr, &status);
    fits_get_num_hdus(file, &parts, &status);
    for (int part = 1; part <= parts; ++part) {
      int data = 0, whole = 0, type = 0;
      fits_movabs_hdu(file, part, &type, &status);
      fits_verify_chksum(file, &data, &whole, &status);
      EXPECT_EQ(data, 1);
      EXPECT_EQ(whole, 1);
    }
    fits_close_file(file, &status);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(fault_of_fits_sums(bytes), "");
    EXPECT_EQ(missing_fits_data(bytes), "");
    // Twice is as once.
    EXPECT_EQ(with_fits_checksums(bytes), bytes);
  }
}

TEST(FitsChecksum, AChangedOrMissingByteOfTheDataIsRefused) {
  const std::string sound = encode_fits(picture(), {});
  const std::size_t begin = 2880, data = 40 * 31 * 4;
  EXPECT_EQ(read_fits_image(sound, "a.fits").image.data, picture().data);
  for (std::size_t at = begin; at < begin + data; at += 331) {
    std::string changed = sound;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    EXPECT_THROW(read_fits_image(changed, "a.fits"), Error) << at;
  }
  // Cut inside of its last block, which CFITSIO would fill up; and without the filling, which is no fault.
  for (const std::size_t size : {begin + data - 1, begin + data - 400, begin + 3000})
    EXPECT_THROW(read_fits_image(sound.substr(0, size), "a.fits"), Error) << size;
  EXPECT_EQ(read_fits_image(sound.substr(0, begin + data), "a.fits").image.data, picture().data);
}

TEST(FitsChecksum, AHeaderThatOthersHaveChangedIsRead) {
  std::string bytes = encode_fits(picture(), {{"OBSERVER", "nobody", ""}});
  bytes.replace(bytes.find("nobody"), 6, "anyone");
  EXPECT_EQ(read_fits_image(bytes, "a.fits").keywords.at("OBSERVER"), "anyone");
}

TEST(FitsChecksum, AFileWithoutSumsMayOnlyBeShort) {
  const std::string whole = tests::fits_image(16, {40, 31}, std::vector<double>(40 * 31, 7.0));
  EXPECT_EQ(missing_fits_data(whole), "");
  EXPECT_EQ(fault_of_fits_sums(whole), "");
  EXPECT_NE(missing_fits_data(std::string_view(whole).substr(0, 2880 + 2479)), "");
  EXPECT_EQ(missing_fits_data(std::string_view(whole).substr(0, 2880 + 2480)), "");
}

}  // namespace
}  // namespace vegard::sim::fits_checksum_test
