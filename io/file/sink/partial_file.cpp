// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of outputs while they are written, and what killed runs have left under such names.
#include "io/file/sink/partial_file.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "io/codec/checksums.h"
#include "io/file/errors.h"
#include "io/file/file_descriptor.h"
#include "io/file/folder.h"

namespace mw::io {

void sync_folder(const std::filesystem::path& folder) {
  const FileDescriptor handle(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (handle.valid()) ::fsync(handle.get());
}

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPartial = ".partial-";

/// Returns eight digits that two texts seldom have in common.
std::string digits_of(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out;
  for (unsigned i = 0; i < 8; ++i) {
    out += kDigits[checksum(std::as_bytes(std::span(text))) >> 4 * i & 15U];
  }
  return out;
}

/// Returns eight digits that belong, as locks do, to a kernel from its start on.
std::string kernel_mark() {
  std::string id;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> id;
  return digits_of(id);
}

const std::string& this_kernel() {
  static const std::string mark = kernel_mark();
  return mark;
}

/// Returns what partial outputs have of their target's name: all of it, or its beginning and digits
/// where no room would be left for what stands behind it.
std::string short_name(const fs::path& target) {
  constexpr std::size_t kMostBytes = 255;  // of a file's name
  constexpr std::size_t kBehind = 40, kDigits = 8;
  std::string name = target.filename().string();
  if (name.size() + 1 + kBehind <= kMostBytes) return name;
  const std::string digits = digits_of(name);
  std::size_t kept = kMostBytes - 1 - kBehind - 1 - kDigits;
  const auto is_inside_letter = [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0U) == 0x80;
  };
  while (kept > 0 && is_inside_letter(name[kept])) --kept;  // letters of UTF-8 stay whole
  return name.substr(0, kept) + "~" + digits;
}

fs::path partial_name(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  return folder_of(target) /
         text(".", short_name(target), kPartial, this_kernel(), "-", ::getpid(), "-", counter++);
}

FileDescriptor create(const fs::path& path, PartialKind kind) {
  // Not mkostemp: its mode 0600 would survive the rename; here the user's umask holds.
  if (kind == PartialKind::kFile) {
    return FileDescriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  }
  if (::mkdir(path.c_str(), 0777) != 0) return {};
  return FileDescriptor(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

bool lock(const FileDescriptor& file, int how) {
  int done = 0;
  do {
    done = ::flock(file.get(), LOCK_EX | how);
  } while (done != 0 && errno == EINTR);
  return done == 0;
}

bool is_at(const FileDescriptor& file, const fs::path& path) {
  struct stat held {};
  struct stat named {};
  return ::fstat(file.get(), &held) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

/// Whether only this machine can see the file system, so that all who see it see its locks.
bool is_local(const FileDescriptor& file) {
  constexpr std::array<unsigned long, 9> kLocal{
      EXT4_SUPER_MAGIC, XFS_SUPER_MAGIC,       BTRFS_SUPER_MAGIC,    F2FS_SUPER_MAGIC, TMPFS_MAGIC,
      RAMFS_MAGIC,      OVERLAYFS_SUPER_MAGIC, 0x2FC12FC1 /* ZFS */, 0xCA451A4E /* bcachefs */};
  struct statfs facts {};
  if (::fstatfs(file.get(), &facts) != 0) return false;
  const auto type = static_cast<unsigned long>(facts.f_type);
  return std::find(kLocal.begin(), kLocal.end(), type) != kLocal.end();
}

/// Returns the kernel's mark in the name of a partial output whose target has this short name;
/// nothing in another name.
std::string_view mark_of(std::string_view name, std::string_view target) {
  constexpr std::size_t kMark = 8;
  if (name.substr(0, 1) != "." || name.substr(1, target.size()) != target) return {};
  name.remove_prefix(1 + target.size());
  if (!name.starts_with(kPartial) || name.size() < kPartial.size() + kMark + 4) return {};
  const std::string_view mark = name.substr(kPartial.size(), kMark);
  const std::string_view numbers = name.substr(kPartial.size() + kMark);
  const bool is_ours = mark.find_first_not_of("0123456789abcdef") == mark.npos &&
                       numbers.find_first_not_of("-0123456789") == numbers.npos &&
                       numbers[0] == '-';
  return is_ours ? mark : std::string_view{};
}

/// Removes a partial output whose writer is gone.
void remove_if_left(const fs::path& path, std::string_view mark) {
  constexpr int kFlags = O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  FileDescriptor file(::open(path.c_str(), O_RDWR | kFlags));
  if (!file.valid() && errno == EISDIR) {
    file = FileDescriptor(::open(path.c_str(), O_RDONLY | kFlags));
  }
  if (!file.valid() || (mark != this_kernel() && !is_local(file))) return;
  if (!lock(file, LOCK_NB) || !is_at(file, path)) return;
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

/// Returns the names of all partial outputs that were in the folder at the first call for it.
std::vector<std::string> found_in(const fs::path& folder) {
  static std::mutex mutex;
  static std::map<fs::path, std::vector<std::string>> found;
  const std::lock_guard guard(mutex);
  std::error_code ignored;
  const auto [position, is_new] = found.try_emplace(fs::absolute(folder, ignored));
  if (!is_new) return position->second;
  // A folder that cannot be listed keeps what it has; files may be made there all the same.
  std::vector<std::string>& names = position->second;
  names = entries_in(position->first, ignored);
  std::erase_if(names, [](const std::string& name) { return name.find(kPartial) == name.npos; });
  return names;
}

void remove_leftovers(const fs::path& target) {
  const fs::path folder = folder_of(target);
  const std::string short_target = short_name(target);
  for (const std::string& name : found_in(folder)) {
    const std::string_view mark = mark_of(name, short_target);
    if (!mark.empty()) remove_if_left(folder / name, mark);
  }
}

}  // namespace

PartialOutput make_partial(const fs::path& target, PartialKind kind) {
  remove_leftovers(target);
  while (true) {
    PartialOutput out{.path = partial_name(target), .file = {}};
    out.file = create(out.path, kind);
    if (!out.file.valid() && errno == EEXIST) continue;
    if (!out.file.valid()) fail_output(target.string(), "create", errno);
    // In the instant before the lock another run may have taken it for left over.
    if (!lock(out.file, 0) || is_at(out.file, out.path)) return out;
  }
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace mw::io
