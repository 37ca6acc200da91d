// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMappedImageReader
 * @brief   give an image whose samples stay in the file
 *
 * This reader maps a file into the address space: its output is a vtkImageData whose scalars are
 * the bytes of the file. Nothing is read before it is accessed. The operating system keeps in
 * memory as much of the file as there is room for, and drops it again. A volume that is larger than
 * the memory can therefore be opened immediately. vtkIsosurfaceRayTraceMapper uses the samples in
 * place: it reads all of them once, for macrocells, and then those next to the surface.
 *
 * The samples must be stored as they are in memory: uncompressed, in one file, in the byte order of
 * the machine, and beginning at an offset that is a multiple of the size of a number (2 for a
 * short). Anything else is an error that says what to do. These formats are mapped:
 *
 * - MetaImage (.mhd, .mha)
 * - NRRD (.nhdr, .nrrd) with the encoding raw
 * - NIfTI (.nii): of several time steps, the first; the values as they are stored, without applying
 *   scl_slope and scl_inter
 * - the XML format of VTK (.vti) with raw appended data (vtkXMLWriter::EncodeAppendedDataOff,
 *   SetCompressorTypeToNone), in one piece, without hidden points or cells (vtkGhostType); only the
 *   active point scalars
 * - files with any other name, as raw samples: set their extent, type, header size and byte order
 *   as for vtkImageReader2, and FileDimensionality to 3 (2, the default, is an error)
 *
 * The output is what VTK's reader of the format gives, bit for bit, with one difference. Samples
 * that VTK's readers reverse (raw ones without FileLowerLeft and NRRD in a left-handed space along
 * y, NIfTI with a negative qfac along z) stay in the order of the file. The direction matrix of the
 * image, which then has a negative determinant, puts them at the same places in space.
 *
 * The file must not change while the output or a copy of its array is in use. A program that writes
 * a new file under another name and renames it does no harm. If a program truncates the file, this
 * process ends (SIGBUS) when it accesses missing samples. Changes of the samples of the output are
 * not written to the file; each page that is changed becomes memory of the process.
 *
 * SetFileNames() takes the time steps of a volume, each in its own file (not slices, which are not
 * mapped). All must have the same format, size, type and geometry. Their times are 0, 1, 2, ...
 * (TIME_STEPS). A time in between selects the nearest step; without UpdateTimeStep() the first step
 * is selected. While a step is in use, the system reads ahead the next one in the direction of the
 * last two, unless it takes more than a quarter of the memory, so that it is in memory when it is
 * requested.
 *
 * The output for an update extent has whole slices. Files are mapped on POSIX systems; on other
 * systems the reader reports an error.
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
   * Returns 3 if the file has a header and its samples can be mapped; 0 otherwise, also for files
   * without a header, which may still be mapped as raw samples.
   */
  int CanReadFile(VTK_FILEPATH const char* fileName) override;

  /**
   * Set the files of the time steps of a volume. The settings of raw samples do not change.
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
