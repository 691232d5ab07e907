#include "sim/base/file/sha256.h"

#include <cstdio>
#include <fstream>

#include <gtest/gtest.h>

namespace vegard::sim::sha256_test {
namespace {

// The examples that accompany FIPS 180-4, and the million letters of FIPS 180-2, appendix B.3.
TEST(Sha256, PublishedVectors) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// 55 bytes are the most that leave room for the length in the same block. Digests by coreutils' sha256sum.
TEST(Sha256, LengthsAroundABlock) {
  EXPECT_EQ(sha256(std::string(55, 'x')), "d5e285683cd4efc02d021a5c62014694958901005d6f71e89e0989fac77e4072");
  EXPECT_EQ(sha256(std::string(56, 'x')), "04c26261370ee7541549d16dee320c723e3fd14671e66a099afe0a377c16888e");
  EXPECT_EQ(sha256(std::string(64, 'x')), "7ce100971f64e7001e8fe5a51973ecdfe1ced42befe7ee8d5fd6219506b5393c");
}

// However the bytes are cut: within a block, at its end, across it.
TEST(Sha256, PiecesMakeTheSameAsTheWhole) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += static_cast<char>(i * 7);
  for (const std::size_t size : {1, 55, 63, 64, 65, 128, 299}) {
    Sha256 sum;
    for (std::size_t at = 0; at < text.size(); at += size) {
      EXPECT_EQ(sum.digest(), sha256(text.substr(0, at))) << "so far, by " << size;
      sum.add(std::string_view(text).substr(at, size));
    }
    EXPECT_EQ(sum.digest(), sha256(text)) << "by " << size;
  }
}

// Longer than the blocks that a file is read by, and no multiple of them.
TEST(Sha256, OfAFile) {
  const std::string path = testing::TempDir() + "sha256_of_a_file";
  std::string text(2500001, 'a');
  text[1234567] = '\0';
  std::ofstream(path, std::ios::binary) << text;
  EXPECT_EQ(sha256_of_file(path), sha256(text));
  std::remove(path.c_str());
  EXPECT_EQ(sha256_of_file(path), sha256(""));
}

}  // namespace
}  // namespace vegard::sim::sha256_test
