#include "sim/base/file/byte_stream.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/support/frames/gzip_bytes.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::byte_stream_test {
namespace {

using tests::expect_words;
using tests::gzip_stored;

/// More than is looked at, and no byte like its neighbours.
std::string many_bytes() {
  std::string bytes;
  for (std::size_t i = 0; i < 3 * kMaxPeekBytes + 17; ++i) bytes += static_cast<char>(i * i % 251);
  return bytes;
}

std::string all_of(ByteStream& stream) {
  std::string all(1 << 20, '\0');
  all.resize(stream.read(all.data(), all.size()));
  return all;
}

/// The same of a file and of memory, plain and packed.
class AllKinds : public testing::Test {
 protected:
  void SetUp() override {
    tests::put(folder_ / "plain", bytes_);
    tests::put(folder_ / "packed.gz", packed_);
    streams_.emplace_back(folder_ / "plain");
    streams_.emplace_back(folder_ / "packed.gz");
    streams_.emplace_back(bytes_, "plain");
    streams_.emplace_back(packed_, "packed");
  }
  const std::string bytes_ = many_bytes(), packed_ = gzip_stored(bytes_);
  tests::TemporaryFolder folder_;
  std::vector<ByteStream> streams_;
};

TEST_F(AllKinds, GiveAllBytes) {
  for (ByteStream& stream : streams_) {
    EXPECT_EQ(all_of(stream), bytes_);
    EXPECT_EQ(stream.position(), bytes_.size());
    EXPECT_EQ(all_of(stream), "");
    EXPECT_EQ(stream.look(4), "");
  }
  EXPECT_FALSE(streams_[0].is_packed());
  EXPECT_TRUE(streams_[1].is_packed());
}

TEST_F(AllKinds, ShowSkipAndReadInAnyOrder) {
  for (ByteStream& stream : streams_) {
    EXPECT_EQ(stream.look(5), bytes_.substr(0, 5));
    EXPECT_EQ(stream.look(kMaxPeekBytes), bytes_.substr(0, kMaxPeekBytes));
    EXPECT_EQ(stream.position(), 0u);
    EXPECT_EQ(stream.skip(7), 7u);
    EXPECT_EQ(stream.look(kMaxPeekBytes), bytes_.substr(7, kMaxPeekBytes));
    EXPECT_EQ(stream.skip(kMaxPeekBytes + 100), kMaxPeekBytes + 100);
    std::string some(50, '\0');
    EXPECT_EQ(stream.read(some.data(), some.size()), some.size());
    EXPECT_EQ(some, bytes_.substr(kMaxPeekBytes + 107, 50));
    const std::uint64_t left = bytes_.size() - kMaxPeekBytes - 157;
    EXPECT_EQ(stream.skip(1 << 30), left);
    EXPECT_EQ(stream.skip(1), 0u);
  }
}

TEST(ByteStream, OfGzipFilesInARowAndZerosBehindThem) {
  const std::string packed =
      gzip_stored("abc") + gzip_stored("") + gzip_stored("de") + std::string(1000, '\0');
  ByteStream stream(packed, "it");
  EXPECT_EQ(all_of(stream), "abcde");
}

TEST(ByteStream, OfWhatWasPacked) {
  for (const std::string& bytes : {std::string(), std::string("some words"), many_bytes()}) {
    const std::string packed = gzipped(bytes);
    ByteStream stream(packed, "packed");
    EXPECT_EQ(all_of(stream), bytes);
    EXPECT_EQ(gzipped(bytes), packed);
  }
  EXPECT_LT(gzipped(std::string(100000, 'a')).size(), 1000u);
}

TEST(ByteStream, OfNothing) {
  ByteStream stream(std::string_view(), "it");
  EXPECT_EQ(stream.look(2), "");
  EXPECT_FALSE(is_gzip("\x1f"));
}

void refused(const std::string& packed, const std::string& word) {
  expect_words(ErrorKind::unreadable_input, {"it", word}, [&] {
    ByteStream stream(packed, "it");
    all_of(stream);
  });
}

TEST(ByteStream, RefusesDamagedGzip) {
  const std::string packed = gzip_stored("some words");
  // Of each length but the whole; one byte alone is no gzip file.
  for (std::size_t size = 2; size < packed.size(); ++size) refused(packed.substr(0, size), "truncated");
  std::string other = packed;
  other[16] ^= 1;  // a letter
  refused(other, "incorrect data check");
  other = packed;
  other[packed.size() - 1] ^= 1;
  refused(other, "incorrect length check");
  other = packed;
  other[10] = 7;  // a kind of block that there is not
  refused(other, "invalid block type");
  refused(packed + "more", "something else follows");
  refused(packed + std::string(5, '\0') + "more", "something else follows");
}

TEST(ByteStream, IsOfRegularFiles) {
  expect_words(ErrorKind::unreadable_input, {"/nowhere", "no such file"},
               [] { ByteStream stream("/nowhere"); });
  expect_words(ErrorKind::unreadable_input, {"directory"}, [] { ByteStream stream("/tmp"); });
}

}  // namespace
}  // namespace vegard::sim::byte_stream_test
