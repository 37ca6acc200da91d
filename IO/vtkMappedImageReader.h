// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMappedImageReader
 * @brief   give an image whose samples stay in the file
 *
 * This reader maps a file into the address space: its output is a vtkImageData whose scalars are
 * the bytes of the file. Nothing is read until it is looked at, the system keeps in memory what
 * there is room for, and drops it again. So a volume that is larger than the memory is opened at
 * once. vtkIsosurfaceRayTraceMapper uses samples where they are: it reads all of them once, for
 * macrocells, and then those next to the surface.
 *
 * The samples must be stored as they are in memory: uncompressed, in one file, in the byte order of
 * the machine, and from a byte on that the size of a number (2 for a short) divides. All else is an
 * error that says what to do. These are mapped:
 *
 * - MetaImage (.mhd, .mha)
 * - NRRD (.nhdr, .nrrd) with the encoding raw
 * - NIfTI (.nii); of several time steps the first; the values as they are stored, to which
 *   scl_slope and scl_inter are not applied
 * - the XML format of VTK (.vti) with raw appended data (vtkXMLWriter::EncodeAppendedDataOff,
 *   SetCompressorTypeToNone), in one piece, of which nothing is hidden (vtkGhostType); only the
 *   active scalars of the points
 * - files of any other name as raw samples, of which the extent, type, header size and byte order
 *   are set as for vtkImageReader2, and FileDimensionality to 3 (2, the default, is an error)
 *
 * The output is what VTK's reader of the format gives, bit for bit, with one difference. Samples
 * that VTK's readers reverse (raw ones without FileLowerLeft and NRRD in a left-handed space along
 * y, NIfTI with a negative qfac along z) stay in the order of the file: the direction matrix of the
 * image, which has a negative determinant then, puts them to the same places in space.
 *
 * The file must stay as it is while the output or a copy of its array is in use. A program that
 * writes a new file under another name and renames it does no harm. One that cuts off the file ends
 * this process when samples that are missing are looked at (SIGBUS). What is written to the samples
 * of the output is not written to the file. Each page that is written to becomes memory of the
 * process.
 *
 * SetFileNames() takes the time steps of a volume, each in a file of its own (not slices, which are
 * not mapped): all of one format, size, type and geometry. Their times are 0, 1, 2, ...
 * (TIME_STEPS); a time in between is that of the nearest step, and without UpdateTimeStep() it is
 * the first. While a step is in use, the system reads the one that follows in the direction of the
 * last two, unless it takes more than a quarter of the memory: so it is there when it is asked for.
 *
 * An update extent gives whole slices. Memory is mapped on POSIX systems; on others there is an
 * error.
 *
 * @sa vtkImageReader2 vtkMetaImageReader vtkNrrdReader vtkNIFTIImageReader vtkXMLImageDataReader
 */

#ifndef vtkMappedImageReader_h
#define vtkMappedImageReader_h

#include "vtkImageReader2.h"
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h" // for export macro

#include <memory> // for std::unique_ptr
#include <string> // for std::string

namespace ImageFiles
{
class FilePrefetch;
struct MappableImage;
}

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;

class VTKISOSURFACERAYTRACING_EXPORT vtkMappedImageReader : public vtkImageReader2
{
public:
  static vtkMappedImageReader* New();
  vtkTypeMacro(vtkMappedImageReader, vtkImageReader2);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns 3 if the file has a header, and its samples can be mapped; 0 otherwise. Nothing is said
   * of files without a header.
   */
  int CanReadFile(VTK_FILEPATH const char* fileName) override;

  /**
   * Set the files of the time steps of a volume. The settings of raw samples stay as they are.
   */
  void SetFileNames(vtkStringArray* names) override;

  /**
   * Returns whether the values of an array are in a file that a reader of this class has mapped.
   */
  static bool IsMapped(vtkDataArray* array);

  const char* GetFileExtensions() override { return ".mhd .mha .nhdr .nrrd .nii .vti .raw"; }
  const char* GetDescriptiveName() override { return "Mapped image"; }

protected:
  vtkMappedImageReader();
  ~vtkMappedImageReader() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkMappedImageReader(const vtkMappedImageReader&) = delete;
  void operator=(const vtkMappedImageReader&) = delete;

  int GetNumberOfSteps();
  std::string GetFileNameOfStep(int step);
  ImageFiles::MappableImage FindRawImage(const std::string& fileName);
  ImageFiles::MappableImage FindImage(const std::string& fileName);
  ImageFiles::MappableImage FindImageOfStep(int step);
  int ChooseStep(vtkInformation* output);
  void MapSlices(const ImageFiles::MappableImage& image, const int extent[6], vtkImageData* output);
  void PrefetchAfter(int step);

  /// What the file has, or the first of them, once its header was read.
  std::unique_ptr<ImageFiles::MappableImage> Image;
  std::unique_ptr<ImageFiles::FilePrefetch> Prefetch;
  /// The one that was mapped last.
  int Step = 0;
};

VTK_ABI_NAMESPACE_END

#endif
