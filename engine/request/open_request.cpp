// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens the input volume that options describe.
#include "engine/request/volume_options.h"

#include <algorithm>

#include "engine/request/shared_options.h"
#include "engine/request/values.h"
#include "engine/system/crew.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/names/read_names.h"
#include "io/remote/address.h"
#include "io/volume/decode.h"
#include "io/volume/named_volume.h"
#include "io/volume/open_volume.h"

namespace mw::request {
namespace {

io::RawLayout raw_layout(const VolumeRequest& request) {
  if (!request.type) io::fail_usage("--shape: a raw file needs --dtype as well");
  return {.shape = *request.shape,
          .type = *request.type,
          .order = request.order.value_or(io::ByteOrder::kLittle)};
}

/// Opens the volume with its names; note says how these were read, if there is anything to say.
std::unique_ptr<io::LabelVolume> open_named(const VolumeRequest& request, std::string* note) {
  auto volume = io::open_volume(request.path, open_options(request));
  if (request.names.empty()) return volume;
  return std::make_unique<io::NamedVolume>(std::move(volume), io::read_names(request.names, note));
}

}  // namespace

io::OpenOptions open_options(const VolumeRequest& request) {
  io::OpenOptions options = request.open;
  options.at_once = engine::tbb_for_each_index;
  if (request.shape) {
    options.raw = raw_layout(request);
  } else if (request.type || request.order) {
    io::fail_usage("--dtype is for raw files, which need --shape");
  }
  return options;
}

void refuse_idle_cache(const OptionSet& options, const VolumeRequest& request) {
  const std::string path = request.path.string();
  if (!options.is_flag("cache") || io::is_remote_address(path)) return;
  io::fail_usage("--cache: keeps what servers send, and ", path,
                 " comes from no server; leave it out");
}

std::uint64_t cache_bytes(std::uint64_t memory) {
  constexpr std::uint64_t kMax = 1ULL << 30U;
  return std::min(memory / 4, kMax);
}

io::LabelNames names_of(const VolumeRequest& request) {
  VolumeRequest all = request;
  all.open.object.clear();
  return open_named(all, nullptr)->info().names;  // the volume is opened again, and told of then
}

std::unique_ptr<io::LabelVolume> open(const VolumeRequest& request,
                                      const std::function<void(const std::string&)>& warn) {
  std::string note;
  auto volume = open_named(request, &note);
  if (!volume->info().note.empty()) warn(volume->info().note);
  if (!note.empty()) warn(note);
  return volume;
}

}  // namespace mw::request
