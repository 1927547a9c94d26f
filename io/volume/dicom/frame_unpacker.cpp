// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Runs DCMTK's decoders, which fill what a frame lacks and log a warning, which is an error here.
#include "io/volume/dicom/frame_unpacker.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dccodec.h>
#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpls/djdecode.h>
#include <dcmtk/oflog/appender.h>
#include <dcmtk/oflog/oflog.h>
#include <dcmtk/oflog/spi/logevent.h>

#include <limits>

#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "io/names/label_names.h"

namespace mw::io {
namespace {

/// The first warning or error that DCMTK logs.
class FirstWarning : public dcmtk::log4cplus::Appender {
 public:
  explicit FirstWarning(std::string& out) : out_(out) {}
  FirstWarning(const FirstWarning&) = delete;
  FirstWarning& operator=(const FirstWarning&) = delete;
  ~FirstWarning() override { destructorImpl(); }
  void close() override { closed = true; }

 private:
  void append(const dcmtk::log4cplus::spi::InternalLoggingEvent& event) override {
    if (event.getLogLevel() < dcmtk::log4cplus::WARN_LOG_LEVEL || !out_.empty()) return;
    out_ = text("DCMTK says: ", clean_name(event.getMessage().c_str()));
  }

  std::string& out_;
};

/// Collects warnings while it lives.
class WarningWatch {
 public:
  WarningWatch() : appender_(new FirstWarning(first_)) {
    dcmtk::log4cplus::Logger::getRoot().addAppender(appender_);
  }
  WarningWatch(const WarningWatch&) = delete;
  WarningWatch& operator=(const WarningWatch&) = delete;
  ~WarningWatch() { dcmtk::log4cplus::Logger::getRoot().removeAppender(appender_); }

  [[nodiscard]] const std::string& first() const { return first_; }

 private:
  std::string first_;
  dcmtk::log4cplus::SharedAppenderPtr appender_;
};

void register_packings() {
  DcmRLEDecoderRegistration::registerCodecs();
  DJLSDecoderRegistration::registerCodecs();
  DJDecoderRegistration::registerCodecs(EDC_never);  // labels are no colours
}

/// DCMTK 3.6.9 has another name for it than 3.6.7.
template <class Packing>
bool loses_something(const Packing& packing) {
  if constexpr (requires { packing.isPixelDataLossyCompressed(); }) {
    return packing.isPixelDataLossyCompressed();
  } else {
    return packing.isLossy();
  }
}

void check_packing(const DcmXfer& packing, const DicomGrid& grid, const std::string& file) {
  constexpr const char* kField = "Transfer Syntax UID";
  constexpr const char* kUnpack =
      "export it uncompressed, or in RLE or JPEG-LS Lossless, or unpack it, for instance with "
      "gdcmconv --raw";
  if (loses_something(packing)) {
    fail_input(file, kField,
               text("pixels in ", packing.getXferName(), " do not keep the numbers of voxels"),
               "export it again, uncompressed, or in RLE or JPEG-LS Lossless");
  }
  if (grid.bits == 1) {
    fail_input(file, kField,
               text("pixels of one bit in ", packing.getXferName(), " are not unpacked"), kUnpack);
  }
  if (!DcmCodecList::canChangeCoding(packing.getXfer(), EXS_LittleEndianExplicit)) {
    fail_input(file, kField, text("pixels in ", packing.getXferName(), " are not unpacked"),
               kUnpack);
  }
}

}  // namespace

FrameUnpacker::FrameUnpacker(DcmDataset& data, DcmPixelData& pixels, const DicomGrid& grid,
                             const std::string& file)
    : data_(data), pixels_(pixels), grid_(grid), file_(file) {
  const DcmXfer packing(data.getOriginalXfer());
  register_packings();
  check_packing(packing, grid, file);
  is_rle_ = packing.getXfer() == EXS_RLELossless;
  frame_bytes_ = static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns) *
                 static_cast<std::size_t>(grid.bits) / 8;
  const bool is_there =
      pixels.getEncapsulatedRepresentation(packing.getXfer(), nullptr, fragments_).good();
  if (!is_there || fragments_ == nullptr) fail("has no pixels");
  if (frame_bytes_ >= std::numeric_limits<Uint32>::max()) fail("has too many voxels");
  voxels_.resize(frame_bytes_ + frame_bytes_ % 2);  // DCMTK asks for an even number
}

void FrameUnpacker::fail(const std::string& fault) const {
  fail_input(file_, "Pixel Data", text("frame ", frame_ + 1, " ", fault), kCheckDicom);
}

std::string FrameUnpacker::fault_of_header() const {
  DcmPixelItem* fragment = nullptr;
  Uint8* bytes = nullptr;
  if (fragments_->getItem(fragment, fragment_).bad() || fragment == nullptr) return "is missing";
  if (fragment->getUint8Array(bytes).bad() || bytes == nullptr) return "is empty";
  const auto frame = std::as_bytes(std::span(bytes, fragment->getLength()));
  return is_rle_ ? fault_of_rle(frame, grid_) : fault_of_jpeg(frame, grid_);
}

std::span<const std::byte> FrameUnpacker::next() {
  const std::string fault = fault_of_header();
  if (!fault.empty()) fail(fault);
  const WarningWatch watch;
  OFString colours;
  const OFCondition done = pixels_.getUncompressedFrame(
      &data_, frame_, fragment_, voxels_.data(), static_cast<Uint32>(voxels_.size()), colours);
  if (done.bad()) fail(text("cannot be unpacked: ", done.text()));
  if (!watch.first().empty()) fail(text("cannot be unpacked: ", watch.first()));
  ++frame_;
  return std::span(voxels_).first(frame_bytes_);
}

}  // namespace mw::io
