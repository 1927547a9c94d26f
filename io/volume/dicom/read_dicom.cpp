// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a DICOM segmentation by DCMTK, which sees the file in a child process only.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdict.h>
#include <dcmtk/dcmdata/dcfcache.h>
#include <dcmtk/dcmdata/dcfilefo.h>
#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>

#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/source/file_source.h"
#include "io/file/wall/apart.h"
#include "io/names/label_names.h"
#include "io/volume/dicom/frame_unpacker.h"
#include "io/volume/dicom/open_dicom.h"

namespace mw::io {
namespace {

constexpr std::size_t kPieceBytes = 1 << 20;
constexpr std::size_t kMostNameBytes = 255;
/// More would not fit the numbers of segments or the memory of the child.
constexpr std::int32_t kMostSegmentNumber = 65535, kMostFrames = 1 << 22;
/// Label Map Segmentation Storage, which DCMTK 3.6.7 has no name for.
constexpr const char* kLabelMapClass = "1.2.840.10008.5.1.4.1.1.66.7";

/// What the child sends first.  Segments, frames and the bytes of the pixels follow.
struct SentSizes {
  DicomGrid grid;
  std::uint64_t segments = 0;
  std::uint64_t frames = 0;
  std::uint64_t pixel_bytes = 0;
};
struct SentSegment {
  std::int32_t number = 0;
  std::array<char, kMostNameBytes + 1> name{};  ///< ends with 0
  Colour colour{};                              ///< four zeros: it has none
};

std::uint64_t pixel_bytes_of(const DicomGrid& grid, std::uint64_t frames) {
  const auto voxels =
      static_cast<std::uint64_t>(grid.rows) * static_cast<std::uint64_t>(grid.columns);
  return (saturating_product(voxels * static_cast<std::uint64_t>(grid.bits), frames) + 7) / 8;
}

/// Loads the dictionary of DICOM that lies beside DCMTK's library, as in a wheel, unless DCMTK has
/// found the system's.  Files that do not tell the types of their values cannot be read without.
void load_dictionary() {
  Dl_info place{};
  const bool is_loaded = dcmDataDict.isDictionaryLoaded();
  if (is_loaded || ::dladdr(&dcmDataDict, &place) == 0 || place.dli_fname == nullptr) return;
  const std::filesystem::path file =
      std::filesystem::path(place.dli_fname).parent_path() / "dicom.dic";
  dcmDataDict.wrlock().loadDictionary(file.c_str());
  dcmDataDict.wrunlock();
}

/// One file in the child.
class DicomReader {
 public:
  DicomReader(const std::string& path, const std::string& name) : name_(name) {
    load_dictionary();
    constexpr Uint32 kMostInMemory = 4096;  // pixels stay on the disk
    check(file_.loadFile(path.c_str(), EXS_Unknown, EGL_noChange, kMostInMemory), "structure");
    data_ = file_.getDataset();
    OFString kind;
    data_->findAndGetOFString(DCM_SOPClassUID, kind);
    if (kind != UID_SegmentationStorage && kind != kLabelMapClass) {
      fail_input(name_, "SOP Class UID", "the file is DICOM, but no segmentation",
                 "images have no labels: export a DICOM segmentation, NIfTI or NRRD file of them, "
                 "for instance with 3D Slicer");
    }
    data_->convertToUTF8();
    if (data_->findAndGetSequenceItem(DCM_SharedFunctionalGroupsSequence, shared_).bad()) {
      shared_ = nullptr;
    }
  }

  void send(const SendBytes& send) {
    read_frames();
    read_grid();
    read_segments();
    match_frames();
    DcmPixelData& pixels = pixel_data();
    const SentSizes sizes{.grid = grid_,
                          .segments = segments_.size(),
                          .frames = frames_.size(),
                          .pixel_bytes = pixel_bytes_of(grid_, frames_.size())};
    std::optional<FrameUnpacker> unpacker;
    if (is_packed(DcmXfer(data_->getOriginalXfer()))) {
      unpacker.emplace(*data_, pixels, grid_, name_);
    } else {
      check_length(pixels, sizes.pixel_bytes);
    }
    send(std::as_bytes(std::span(&sizes, 1)));
    send(std::as_bytes(std::span(segments_)));
    send(std::as_bytes(std::span(frames_)));
    if (!unpacker) return send_plain(pixels, sizes.pixel_bytes, send);
    for (std::size_t i = 0; i < frames_.size(); ++i) send(unpacker->next());
  }

 private:
  void check(const OFCondition& done, const char* attribute) const {
    if (done.good()) return;
    fail_input(name_, text("DICOM ", attribute), text("cannot be read: ", done.text()),
               kCheckDicom);
  }
  void demand(bool met, const char* attribute, const std::string& otherwise) const {
    if (!met) fail_input(name_, attribute, otherwise, kCheckDicom);
  }

  [[nodiscard]] DcmPixelData& pixel_data() const {
    DcmElement* found = nullptr;
    check(data_->findAndGetElement(DCM_PixelData, found), "Pixel Data");
    auto* const pixels = dynamic_cast<DcmPixelData*>(found);
    demand(pixels != nullptr, "Pixel Data", "has no pixels");
    return *pixels;
  }

  /// A label map may have one padding byte; with more, its voxels have another size than they say.
  void check_length(DcmPixelData& pixels, std::uint64_t bytes) const {
    const std::uint64_t length = pixels.getLength();
    const bool may_be_longer = grid_.voxels == DicomVoxels::kMasks;
    demand(length >= bytes && (may_be_longer || length <= bytes + 1), "Pixel Data",
           text("has ", length, " bytes, and the frames need ", bytes));
  }

  void send_plain(DcmPixelData& pixels, std::uint64_t bytes, const SendBytes& send) const {
    std::vector<std::byte> piece;
    DcmFileCache cache;
    for (std::uint64_t at = 0; at < bytes; at += piece.size()) {
      piece.resize(std::min<std::uint64_t>(kPieceBytes, bytes - at));
      check(pixels.getPartialValue(piece.data(), static_cast<Uint32>(at),
                                   static_cast<Uint32>(piece.size()), &cache, EBO_LittleEndian),
            "Pixel Data");
      send(piece);
    }
  }

  /// Returns a number of any type by its text; 0 where there is none.
  [[nodiscard]] static double number(DcmItem* item, const DcmTagKey& key, unsigned long at = 0) {
    OFString digits;
    if (item == nullptr || item->findAndGetOFString(key, digits, at).bad()) return 0;
    const double value = OFStandard::atof(digits.c_str());
    return std::isfinite(value) ? value : 0;
  }
  [[nodiscard]] std::int32_t whole(const DcmTagKey& key) const { return whole(data_, key); }
  /// Returns -1 for what is none of 0 to 1e9.
  [[nodiscard]] static std::int32_t whole(DcmItem* item, const DcmTagKey& key) {
    const double value = number(item, key);
    return value >= 0 && value <= 1e9 ? static_cast<std::int32_t>(value) : -1;
  }

  /// Returns the colour in which the segment is shown; four zeros where there is none.
  [[nodiscard]] static Colour colour_of(DcmItem* segment) {
    const Uint16* values = nullptr;
    unsigned long count = 0;
    const OFCondition found =
        segment->findAndGetUint16Array(DCM_RecommendedDisplayCIELabValue, values, &count);
    if (found.bad() || values == nullptr || count != 3) return {};
    return srgb_of(cielab_of({values[0], values[1], values[2]}));
  }

  /// Returns a functional group: the frame's own, or the one that all frames share, or null.
  [[nodiscard]] DcmItem* group(DcmItem* frame, const DcmTagKey& sequence) const {
    for (DcmItem* from : {frame, shared_}) {
      DcmItem* found = nullptr;
      if (from != nullptr && from->findAndGetSequenceItem(sequence, found).good()) return found;
    }
    return nullptr;
  }

  static void add_vector(DcmItem* item, const DcmTagKey& key, unsigned long first, Vector3& out) {
    for (unsigned k = 0; k < 3; ++k) out[k] = number(item, key, first + k);
  }

  /// Returns what the frame says about the grid, which must be what all others say.
  [[nodiscard]] DicomGrid grid_of(DcmItem* frame) const {
    DicomGrid out;
    DcmItem* const orientation = group(frame, DCM_PlaneOrientationSequence);
    add_vector(orientation, DCM_ImageOrientationPatient, 0, out.along_row);
    add_vector(orientation, DCM_ImageOrientationPatient, 3, out.along_column);
    DcmItem* const measures = group(frame, DCM_PixelMeasuresSequence);
    out.row_spacing = number(measures, DCM_PixelSpacing, 0);
    out.column_spacing = number(measures, DCM_PixelSpacing, 1);
    out.slice_spacing = number(measures, DCM_SpacingBetweenSlices);
    out.slice_thickness = number(measures, DCM_SliceThickness);
    return out;
  }

  void read_frames() {
    DcmSequenceOfItems* groups = nullptr;
    check(data_->findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, groups),
          "Per-Frame Functional Groups Sequence");
    const std::int32_t count = whole(DCM_NumberOfFrames);
    demand(count > 0 && count <= kMostFrames, "Number of Frames", "is no number of frames");
    DcmObject* next = nullptr;
    while ((next = groups->nextInContainer(next)) != nullptr) {
      auto* const frame = dynamic_cast<DcmItem*>(next);
      if (frame == nullptr) continue;
      add_frame(frame);
    }
    demand(frames_.size() == static_cast<std::size_t>(count),
           "Per-Frame Functional Groups Sequence",
           text("has ", frames_.size(), " items for ", count, " frames"));
  }

  void add_frame(DcmItem* frame) {
    DicomFrame out;
    DcmItem* const position = group(frame, DCM_PlanePositionSequence);
    demand(position != nullptr, "Plane Position Sequence", "a frame has no position");
    add_vector(position, DCM_ImagePositionPatient, 0, out.first);
    out.segment =
        whole(group(frame, DCM_SegmentIdentificationSequence), DCM_ReferencedSegmentNumber);
    const DicomGrid grid = grid_of(frame);
    demand(grid.along_row != Vector3{} && grid.along_column != Vector3{},
           "Image Orientation (Patient)", "a frame has none");
    demand(grid.row_spacing > 0 && grid.column_spacing > 0, "Pixel Spacing", "a frame has none");
    if (frames_.empty()) grid_ = grid;
    const bool is_same =
        grid.along_row == grid_.along_row && grid.along_column == grid_.along_column &&
        grid.row_spacing == grid_.row_spacing && grid.column_spacing == grid_.column_spacing;
    demand(is_same, "Plane Orientation Sequence", "frames are turned or spaced differently");
    frames_.push_back(out);
  }

  void read_grid() {
    grid_.rows = whole(DCM_Rows);
    grid_.columns = whole(DCM_Columns);
    demand(grid_.rows > 0 && grid_.rows <= 65535 && grid_.columns > 0 && grid_.columns <= 65535,
           "Rows and Columns", "are no numbers of voxels");
    grid_.bits = whole(DCM_BitsAllocated);
    OFString type;
    data_->findAndGetOFString(DCM_SegmentationType, type);
    if (type == "LABELMAP" && (grid_.bits == 8 || grid_.bits == 16)) {
      read_label_type();
    } else if (type == "FRACTIONAL" && grid_.bits == 8) {
      const std::int32_t most = whole(DCM_MaximumFractionalValue);
      demand(most >= 1 && most <= 255, "Maximum Fractional Value", "is not from 1 to 255");
      grid_.threshold = (most + 1) / 2;
    } else if (type != "BINARY" || grid_.bits != 1) {
      fail_input(name_, "Segmentation Type",
                 text("'", clean_name(type.c_str()), "' of ", grid_.bits, " bits is not read"),
                 "export it as BINARY, or as NIfTI or NRRD");
    }
  }

  /// Ignores a palette, as the voxels are numbers of segments also where there is one.
  void read_label_type() {
    demand(whole(DCM_SamplesPerPixel) == 1, "Samples per Pixel",
           "is not 1, and a voxel of a label map has one number");
    demand(whole(DCM_PixelRepresentation) == 0, "Pixel Representation",
           "is not 0, and numbers of segments have no sign");
    const std::int32_t largest = (1 << grid_.bits) - 1;
    grid_.voxels = DicomVoxels::kLabels;
    grid_.background = whole(DCM_PixelPaddingValue);
    demand(grid_.background >= 0 && grid_.background <= largest, "Pixel Padding Value",
           text("is not from 0 to ", largest));
  }

  void read_segments() {
    const std::int32_t least = grid_.voxels == DicomVoxels::kLabels ? 0 : 1;
    DcmSequenceOfItems* sequence = nullptr;
    check(data_->findAndGetSequence(DCM_SegmentSequence, sequence), "Segment Sequence");
    DcmObject* next = nullptr;
    while ((next = sequence->nextInContainer(next)) != nullptr) {
      auto* const item = dynamic_cast<DcmItem*>(next);
      if (item == nullptr) continue;
      demand(item->tagExistsWithValue(DCM_SegmentNumber), "Segment Number", "a segment has none");
      SentSegment out{.number = whole(item, DCM_SegmentNumber)};
      demand(out.number >= least && out.number <= kMostSegmentNumber, "Segment Number",
             text("a segment has none from ", least, " to ", kMostSegmentNumber));
      OFString label;
      item->findAndGetOFString(DCM_SegmentLabel, label);
      const std::string_view kept(label.c_str(), std::min(label.size(), kMostNameBytes));
      std::copy(kept.begin(), kept.end(), out.name.begin());
      out.colour = colour_of(item);
      segments_.push_back(out);
    }
  }

  /// Checks that each frame has a segment.  REQUIRES: segments were read.
  void match_frames() {
    for (DicomFrame& frame : frames_) {
      if (grid_.voxels == DicomVoxels::kLabels) {
        frame.segment = kAllSegments;
        continue;
      }
      const bool is_known = std::any_of(segments_.begin(), segments_.end(),
                                        [&](const auto& s) { return s.number == frame.segment; });
      demand(is_known, "Referenced Segment Number",
             text("a frame is of segment ", frame.segment, ", which is not there"));
    }
  }

  const std::string& name_;
  DcmFileFormat file_;
  DcmDataset* data_ = nullptr;
  DcmItem* shared_ = nullptr;
  DicomGrid grid_;
  std::vector<SentSegment> segments_;
  std::vector<DicomFrame> frames_;
};

/// Writes the bytes to a file that DCMTK can open by a path, however they were packed.
FileDescriptor as_file(const ByteSource& source) {
  UnlinkedFile out(scratch_folder());
  std::vector<std::byte> piece;
  const std::uint64_t size = source.size();
  for (std::uint64_t at = 0; at < size; at += piece.size()) {
    piece.resize(std::min<std::uint64_t>(kPieceBytes, size - at));
    source.read_at(at, piece);
    out.write_at(at, piece);
  }
  return out.release();
}

/// Takes what a child sends, in this process.
class DicomReceiver {
 public:
  explicit DicomReceiver(const std::string& name) : name_(name) {}

  void receive(ApartStream& stream) {
    SentSizes sizes;
    if (!stream.read(std::as_writable_bytes(std::span(&sizes, 1)))) return;
    if (sizes.segments > kMostSegmentNumber + 1 || sizes.frames > kMostFrames ||
        !is_sound(sizes.grid) || sizes.pixel_bytes != pixel_bytes_of(sizes.grid, sizes.frames)) {
      return;
    }
    std::vector<SentSegment> segments(sizes.segments);
    result_.frames.resize(sizes.frames);
    if (!stream.read(std::as_writable_bytes(std::span(segments))) ||
        !stream.read(std::as_writable_bytes(std::span(result_.frames)))) {
      return;
    }
    result_.grid = sizes.grid;
    for (SentSegment& s : segments) {
      s.name.back() = '\0';
      result_.segments.push_back(
          {.number = s.number, .name = clean_name(s.name.data()), .colour = {}});
      if (s.colour != Colour{}) result_.segments.back().colour = s.colour;
    }
    if (!is_sound(result_)) return;
    receive_pixels(stream, sizes.pixel_bytes);
  }

  /// Returns what has come.  ERRORS: mw::Error(kInput) unless it is all.
  [[nodiscard]] DicomSegments result(const std::string& death) && {
    if (is_complete_ && death.empty()) return std::move(result_);
    fail_input(name_, "DICOM structure",
               text("the DCMTK library could not read it: ",
                    death.empty() ? "its answer is broken" : death),
               kCheckDicom);
  }

 private:
  void receive_pixels(ApartStream& stream, std::uint64_t bytes) {
    UnlinkedFile pixels(scratch_folder());
    std::vector<std::byte> piece;
    for (std::uint64_t at = 0; at < bytes; at += piece.size()) {
      piece.resize(std::min<std::uint64_t>(kPieceBytes, bytes - at));
      if (!stream.read(piece)) return;
      pixels.write_at(at, piece);
    }
    result_.pixels = std::make_shared<FileSource>(pixels.release(), bytes, name_);
    is_complete_ = true;
  }

  const std::string& name_;
  DicomSegments result_;
  bool is_complete_ = false;
};

bool is_finite(const Vector3& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

/// Whether a length is one, or 0 where that is allowed.
bool is_length(double length, bool may_be_none) {
  return std::isfinite(length) && (may_be_none || length > 0);
}

}  // namespace

bool is_sound(const DicomGrid& grid) {
  constexpr std::int32_t kMostVoxels = 65535;
  const auto is_from = [](std::int32_t number, std::int32_t least, std::int32_t most) {
    return number >= least && number <= most;
  };
  const bool is_map = grid.voxels == DicomVoxels::kLabels;
  const bool fits =
      is_map
          ? (grid.bits == 8 || grid.bits == 16) && is_from(grid.background, 0, (1 << grid.bits) - 1)
          : grid.voxels == DicomVoxels::kMasks && (grid.bits == 1 || grid.bits == 8) &&
                is_from(grid.threshold, 1, 255);
  return fits && is_from(grid.rows, 1, kMostVoxels) && is_from(grid.columns, 1, kMostVoxels) &&
         is_finite(grid.along_row) && is_finite(grid.along_column) &&
         is_length(grid.column_spacing, false) && is_length(grid.row_spacing, false) &&
         is_length(grid.slice_spacing, true) && is_length(grid.slice_thickness, true);
}

bool is_sound(const DicomSegments& dicom) {
  if (!is_sound(dicom.grid) || dicom.frames.empty()) return false;
  const bool is_map = dicom.grid.voxels == DicomVoxels::kLabels;
  std::vector<std::int32_t> numbers;
  for (const DicomSegment& s : dicom.segments) {
    if (s.number < (is_map ? 0 : 1) || s.number > kMostSegmentNumber) return false;
    numbers.push_back(s.number);
  }
  if (is_map) numbers = {kAllSegments};
  std::sort(numbers.begin(), numbers.end());
  return std::all_of(dicom.frames.begin(), dicom.frames.end(), [&](const DicomFrame& f) {
    return is_finite(f.first) && std::binary_search(numbers.begin(), numbers.end(), f.segment);
  });
}

DicomSegments read_dicom_segments(const ByteSource& source) {
  constexpr std::uint64_t kBytesASecond = 4 << 20, kSeconds = 10;
  const FileDescriptor file = as_file(source);
  DicomReceiver receiver(source.name());
  const std::string death = stream_apart(
      {},
      [&](const SendBytes& send) {
        allow_cpu_seconds(kSeconds + source.size() / kBytesASecond);
        DicomReader(text("/proc/self/fd/", file.get()), source.name()).send(send);
      },
      [&](ApartStream& stream) { receiver.receive(stream); });
  return std::move(receiver).result(death);
}

}  // namespace mw::io
