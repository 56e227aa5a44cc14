// Data arrays of VTK XML files: ascii, base64 in the element, or appended, raw or base64; blocks
// compressed by zlib if the root names vtkZLibDataCompressor.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/surface/numbers.h"
#include "formats/surface/vtp_blocks.h"
#include "formats/surface/xml.h"

namespace mvs::core {

class VtpData {
 public:
  // `root` is the element VTKFile, `appended` nullable.
  VtpData(const XmlElement &root, const XmlElement *appended, size_t file_bytes);

  // The numbers of a DataArray; fails unless there are `count`.
  std::vector<double> numbers(const XmlElement &array, uint64_t count);
  // The texts of an Array of strings, which are bytes, each with a zero behind it.
  std::vector<std::string> texts(const XmlElement &array);

 private:
  std::string block(const XmlElement &array);
  std::string appended_block(const XmlElement &array);
  std::string base64_block(std::string_view text, const XmlElement &array);
  std::string compressed_base64(std::string_view text, const XmlElement &array);
  std::string compressed_raw(std::string_view rest, const XmlElement &array);
  std::string inflated(const VtpBlocks &blocks, std::string_view stored, const XmlElement &array);
  uint64_t length_at(std::string_view header, const XmlElement &array) const;
  uint64_t block_count(std::string_view header, const XmlElement &array) const;
  VtpBlocks blocks_at(std::string_view header, const XmlElement &array) const;
  void use(uint64_t bytes, const XmlElement &array);

  std::string_view appended_;  // behind the underscore
  bool is_raw_ = false, is_big_endian_ = false, is_compressed_ = false;
  size_t header_size_ = 4;  // bytes
  uint64_t unused_;         // bytes of the file that no array has used
};

}  // namespace mvs::core
