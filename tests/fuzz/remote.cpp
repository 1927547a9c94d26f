// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What servers send: headers, whole answers, documents of stores, and answers kept on disk.
#include <algorithm>
#include <array>

#include "io/codec/hasher.h"
#include "io/file/byte_order.h"
#include "io/remote/address.h"
#include "io/remote/disk_cache.h"
#include "io/remote/http_client.h"
#include "io/remote/http_headers.h"
#include "io/volume/n5/open_n5.h"
#include "io/volume/precomputed/open_precomputed.h"
#include "io/volume/zarr/open_zarr.h"
#include "tests/fuzz/all_targets.h"
#include "tests/fuzz/byte_file.h"
#include "tests/fuzz/choices.h"
#include "tests/fuzz/file_tree.h"
#include "tests/fuzz/look_at_volume.h"
#include "tests/io/remote/one_answer.h"

namespace mw::fuzz {
namespace {

/// Counts what comes.
class CountingSink : public io::BodySink {
 public:
  void restart() override { bytes_ = 0; }
  void take(std::span<const std::byte> bytes) override { bytes_ += bytes.size(); }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  std::uint64_t bytes_ = 0;
};

/// A client that asks once and follows no redirect, which could lead out of this machine.
io::HttpClient impatient_client() {
  return io::HttpClient(
      {.attempts = 1, .first_wait = {}, .max_wait = {}, .stalled_seconds = 5, .redirects = 0});
}

void check_part(const io::RemotePart& part, std::uint64_t offset, std::uint64_t wanted) {
  require(part.bytes > 0 && part.bytes <= wanted, "a part has bytes, and no more than asked for");
  require(part.file_bytes > offset, "a part begins within the file");
  require(part.bytes == std::min(wanted, part.file_bytes - offset),
          "a part ends where it was to end, or with the file");
}

/// Shows the files of a folder as a server does, which lists no folders and is far away.
class FarStore : public io::Store {
 public:
  static constexpr std::string_view kAddress = "http://server";

  explicit FarStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] std::unique_ptr<io::ByteSource> open(const std::string& name,
                                                     std::uint64_t max) const override {
    auto found = near(name).open_if_there(max);
    if (found && found->size() > max) io::fail_input(name, {}, "the server sends too much");
    return found;
  }
  [[nodiscard]] std::unique_ptr<io::ByteSource> open_parts(const std::string& name) const override {
    return near(name).open_parts_if_there();
  }
  [[nodiscard]] std::shared_ptr<const io::ByteSource> open_part(const std::string& name,
                                                                std::uint64_t offset,
                                                                std::uint64_t size,
                                                                std::string label) const override {
    return near(name).open_part(offset, size, std::move(label));
  }
  [[nodiscard]] std::uint64_t held_bytes(std::uint64_t max) const override { return max; }
  [[nodiscard]] bool has_file(const std::string& name) const override {
    return near(name).is_file();
  }
  [[nodiscard]] std::optional<bool> has_folder(const std::string& /*name*/) const override {
    return std::nullopt;
  }
  [[nodiscard]] std::optional<std::vector<std::string>> folders_in(
      const std::string& /*name*/) const override {
    return std::nullopt;
  }
  [[nodiscard]] bool is_near() const override { return false; }
  [[nodiscard]] std::string below(const std::string& name, std::string_view more) const override {
    return io::address_below(name, more);
  }
  [[nodiscard]] std::optional<std::pair<std::string, std::string>> above(
      const std::string& name) const override {
    return io::split_address(name);
  }

 private:
  [[nodiscard]] io::Place near(const std::string& name) const {
    require(name.starts_with(kAddress), "nothing is asked of other servers");
    return std::filesystem::path(folder_.string() + name.substr(kAddress.size()));
  }

  std::filesystem::path folder_;
};

using CountScales = std::size_t (*)(const io::Place&, const io::OpenOptions&);
using OpenPlace = std::unique_ptr<io::LabelVolume> (*)(const io::Place&, const io::OpenOptions&);

void look_at_scales(const io::Place& place, CountScales count, OpenPlace open) {
  constexpr std::size_t kMost = 3;
  io::OpenOptions options{.cache_bytes = 1 << 20};
  std::size_t scales = 0;
  ends_well([&] { scales = count(place, options); });
  for (std::size_t i = 0; i < std::min(scales, kMost); ++i) {
    options.scale = static_cast<int>(i);
    ends_well([&] { look_at(*open(place, options)); });
  }
}

constexpr io::ContentDigest kKey{1, 2};

/// The bytes, and behind them the tail of the answer of kKey, whose digest is right.
std::string as_answer(Bytes bytes, std::uint64_t version_bytes, std::uint64_t file_bytes) {
  std::string out(text_of(bytes));
  io::DigestMaker maker;
  maker.add(kKey);
  maker.add(bytes);
  const std::array<std::uint64_t, 3> counts{bytes.size() - version_bytes, version_bytes,
                                            file_bytes};
  for (const std::uint64_t count : counts) maker.add(count);
  const io::ContentDigest digest = maker.finish();
  out += "MWCACHE2";
  for (const std::uint64_t word : {counts[0], counts[1], counts[2], digest.first, digest.second}) {
    std::array<char, 8> stored{};
    io::store_little(word, reinterpret_cast<std::byte*>(stored.data()));
    out.append(stored.data(), stored.size());
  }
  return out;
}

void check_kept(const io::CachedAnswer& found, std::string_view content) {
  const std::uint64_t size = found.bytes->size();
  require(size + found.version.size() <= content.size(), "an answer is no longer than its file");
  require(io::read_whole(*found.bytes, size) == content.substr(0, size),
          "an answer has the bytes of its file");
  require(found.version == content.substr(size, found.version.size()),
          "a version stands behind the bytes");
}

}  // namespace

/// Lines of one or several answers.
void fuzz_http_headers(Bytes bytes) {
  io::HttpHeaders headers;
  std::string_view rest = text_of(bytes);
  while (!rest.empty()) {
    const std::size_t length = std::min(rest.find('\n'), rest.size() - 1) + 1;
    headers.add(rest.substr(0, length));
    rest.remove_prefix(length);
  }
  const auto range = io::parse_content_range(headers.content_range);
  if (range) {
    require(range->first <= range->last && range->last < range->file_bytes, "a range is a part");
  }
  require(!headers.version().starts_with("W/"), "a weak ETag is no version");
  require(headers.content_length.empty() || headers.has_end(), "a length is an end");
  static_cast<void>(headers.is_packed());
}

/// The first line is an address, the second a path below it.
void fuzz_addresses(Bytes bytes) {
  const std::string_view text = text_of(bytes);
  const std::size_t line = std::min(text.find('\n'), text.size());
  const std::string_view given = text.substr(0, line);
  const std::string_view path = text.substr(std::min(line + 1, text.size()));
  ends_well([&] { io::check_scheme(given); });
  if (!io::is_remote_address(given)) return;
  ends_well([&] {
    const std::string address = io::web_address(given);
    require(address.starts_with("http://") || address.starts_with("https://"), "it is of the web");
    require(io::web_address(address) == address, "a web address is its own");
    const std::string server = address.substr(0, address.find('/', std::string("https://").size()));
    const std::string below = io::address_below(address, path);
    require(below == server || below.starts_with(server + "/"), "paths lead to no other server");
    require(io::is_open_to_all(address) == io::is_open_to_all(below), "paths keep secrets");
    const auto part = io::split_address(io::address_below(address, "a%b c"));
    require(part && part->first == address && part->second == "a%b c", "names come back");
  });
}

/// The first bytes say what is asked for, the others are what a server answers.
void fuzz_http(Bytes bytes) {
  Choices choices(bytes);
  const bool is_whole = choices.below(2) == 0;
  const std::uint64_t offset = choices.byte(), wanted = 1 + choices.byte();
  const io::OneAnswer server{std::string(text_of(choices.rest()))};
  const io::HttpClient client = impatient_client();
  ends_well([&] {
    try {
      if (is_whole) {
        CountingSink body;
        const io::Presence presence = client.get(server.address(), wanted, body);
        require(presence != io::Presence::kThere || body.bytes() <= wanted, "no more than allowed");
        return;
      }
      std::vector<std::byte> out(wanted);
      const auto part = client.get_part(server.address(), offset, out);
      if (part) check_part(*part, offset, wanted);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kResource) throw;  // the server does not answer
    }
  });
}

/// A folder as a server shows it; all its scales are looked at.
void fuzz_remote(Bytes bytes) {
  const FileTree files(bytes);
  const io::Place place(std::make_shared<FarStore>(files.path()), std::string(FarStore::kAddress));
  ends_well([&] {
    if (io::is_precomputed(place)) {
      look_at_scales(place, io::count_precomputed_scales, io::open_precomputed);
    } else if (io::is_n5(place)) {
      look_at_scales(place, io::count_n5_scales, io::open_n5);
    } else if (io::is_zarr(place)) {
      look_at_scales(place, io::count_zarr_scales, io::open_zarr);
    }
  });
}

/// The first byte says whether the others are a whole file of a cache, or what a tail follows that
/// is right.
void fuzz_cache(Bytes bytes) {
  Choices choices(bytes);
  const bool has_tail = choices.below(2) == 0;
  const std::uint64_t version_bytes = has_tail ? choices.byte() : 0;
  const Bytes rest = choices.rest();
  const std::string content = has_tail
                                  ? as_answer(rest, version_bytes, std::uint64_t{choices.byte()})
                                  : std::string(text_of(rest));
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "00" / "000000000000010000000000000002";
  std::filesystem::create_directory(path.parent_path());
  std::ofstream(path, std::ios::binary) << content;
  io::DiskCache cache({folder.path()});
  const auto found = cache.find(kKey, "name");
  if (found) check_kept(*found, content);
  require(std::filesystem::exists(path) == found.has_value(), "what is no answer is removed");
  require(found.has_value() || !has_tail || version_bytes > rest.size(), "an answer is found");
  cache.keep(kKey, {std::make_shared<ByteFile>(rest), 7, "version"});
  const auto kept = cache.find(kKey, "name");
  require(kept && kept->version == "version" && kept->file_bytes == 7, "an answer is replaced");
  require(io::read_whole(*kept->bytes, rest.size()) == text_of(rest), "its bytes come back");
}

}  // namespace mw::fuzz
