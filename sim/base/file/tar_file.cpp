#include "sim/base/file/tar_file.h"

#include <archive.h>
#include <archive_entry.h>
#include <algorithm>
#include <memory>
#include <new>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"
#include "sim/base/file/input_file.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kBlock = 1 << 16;

/// From some place on: what libarchive reads.
class TarBytes {
 public:
  TarBytes(const std::string& name, std::string_view bytes) : bytes_(name, bytes), block_(kBlock) {}

  void go_to(std::uint64_t place) { at_ = std::min(place, bytes_.size()); }

  la_ssize_t read(const void** to) {
    const std::size_t got = bytes_.read(at_, block_.data(), block_.size());
    *to = block_.data();
    at_ += got;
    return static_cast<la_ssize_t>(got);
  }

  la_int64_t skip(la_int64_t count) {
    const std::uint64_t passed =
        std::min(count < 0 ? 0 : static_cast<std::uint64_t>(count), bytes_.size() - at_);
    at_ += passed;
    return static_cast<la_int64_t>(passed);
  }

 private:
  RandomBytes bytes_;
  std::uint64_t at_ = 0;
  std::vector<char> block_;
};

la_ssize_t read_some(archive*, void* from, const void** to) { return static_cast<TarBytes*>(from)->read(to); }
la_int64_t skip_some(archive*, void* from, la_int64_t count) {
  return static_cast<TarBytes*>(from)->skip(count);
}

struct CloseArchive {
  void operator()(archive* one) const { archive_read_free(one); }
};

Error damaged_tar(const std::string& name, archive* tar) {
  const char* why = archive_error_string(tar);
  return unreadable(name, std::string("the tar is damaged or cut short: ") +
                              (why != nullptr ? why : "it makes no sense"))
      .hint(kCopyAgain);
}

/// A tar ends with blocks of zeros (POSIX, pax); libarchive does not miss them.
void check_end(const RandomBytes& tar) {
  constexpr std::uint64_t kTarBlock = 512;
  const bool is_whole =
      tar.size() >= kTarBlock && tar.size() % kTarBlock == 0 &&
      tar.bytes(tar.size() - kTarBlock, kTarBlock).find_first_not_of('\0') == std::string::npos;
  if (!is_whole)
    throw unreadable(tar.name(), "the tar is damaged or cut short: it has no end").hint(kCopyAgain);
}

/// At the beginning, or at the header of an entry.
std::unique_ptr<archive, CloseArchive> opened(TarBytes& bytes, std::uint64_t place, const std::string& name) {
  bytes.go_to(place);
  std::unique_ptr<archive, CloseArchive> tar(archive_read_new());
  if (tar == nullptr) throw std::bad_alloc();
  archive_read_support_format_tar(tar.get());
  archive_read_set_read_callback(tar.get(), read_some);
  archive_read_set_skip_callback(tar.get(), skip_some);
  archive_read_set_callback_data(tar.get(), &bytes);
  if (archive_read_open1(tar.get()) != ARCHIVE_OK) throw damaged_tar(name, tar.get());
  return tar;
}

}  // namespace

bool is_tar(std::string_view beginning) {
  constexpr std::size_t kMagicAt = 257;
  constexpr std::string_view kMagic = "ustar";
  return beginning.size() > kMagicAt && beginning.substr(kMagicAt, kMagic.size()) == kMagic;
}

TarFile::TarFile(std::string name, std::string_view bytes) : name_(std::move(name)), bytes_(bytes) {
  check_end(RandomBytes(name_, bytes_));
  TarBytes source(name_, bytes_);
  const auto tar = opened(source, 0, name_);
  archive_entry* entry = nullptr;
  for (std::size_t passed = 0;; ++passed) {
    const int code = archive_read_next_header(tar.get(), &entry);
    if (code == ARCHIVE_EOF) break;
    if (code != ARCHIVE_OK && code != ARCHIVE_WARN) throw damaged_tar(name_, tar.get());
    if (passed >= kMaxEntries)
      throw unreadable(name_, "there are more than " + std::to_string(kMaxEntries) + " files in it")
          .hint("cut it up");
    const char* path = archive_entry_pathname(entry);
    if (path != nullptr &&
        (archive_entry_hardlink(entry) != nullptr || archive_entry_filetype(entry) == AE_IFLNK))
      links_.emplace_back(path);
    if (archive_entry_filetype(entry) != AE_IFREG || archive_entry_hardlink(entry) != nullptr ||
        path == nullptr || archive_entry_size_is_set(entry) == 0)
      continue;
    const la_int64_t size = archive_entry_size(entry);
    if (size < 0 || static_cast<std::uint64_t>(size) > kMaxEntryBytes)
      throw unreadable(name_, "a file in it claims " + std::to_string(size) + " bytes")
          .expected("at most " + bytes_text(kMaxEntryBytes) + " each");
    entries_.push_back({path, static_cast<std::uint64_t>(archive_read_header_position(tar.get())),
                        static_cast<std::uint64_t>(size)});
  }
}

std::string TarFile::read(const TarEntry& wanted) const {
  TarBytes source(name_, bytes_);
  const auto tar = opened(source, wanted.offset, name_);
  archive_entry* entry = nullptr;
  const int code = archive_read_next_header(tar.get(), &entry);
  if (code != ARCHIVE_OK && code != ARCHIVE_WARN) throw damaged_tar(name_, tar.get());
  // Room is made as bytes come: a header may promise any number of them.
  std::string content;
  std::vector<char> block(kBlock);
  for (;;) {
    const la_ssize_t got = archive_read_data(tar.get(), block.data(), block.size());
    if (got == 0) break;
    if (got < 0) throw damaged_tar(name_, tar.get());
    content.append(block.data(), static_cast<std::size_t>(got));
    if (content.size() > wanted.bytes) break;
  }
  if (content.size() != wanted.bytes)
    throw unreadable(name_, "the tar is damaged or cut short: of '" + wanted.name + "' " +
                                std::to_string(content.size()) + " bytes are there, " +
                                std::to_string(wanted.bytes) + " are promised")
        .hint(kCopyAgain);
  return content;
}

}  // namespace vegard::sim
