// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceGhostBlocks
 * @brief   gives each process the AMR blocks of others that are next to its own
 *
 * In AMR data, a surface continues from block to block by the samples on both sides, and a block is
 * not drawn where another block refines it. Blocks that are distributed over processes have
 * neighbours in other processes, for which VTK makes no ghost cells. Without these neighbours, the
 * pictures that vtkIsosurfaceRayTraceCompositor composites have gaps and steps between the blocks
 * of different processes. With them, the pictures are those of one process:
 *
 * @code
 * ghosts->SetInputData(amr); // in each process; of the global controller
 * mapper->SetInputConnection(ghosts->GetOutputPort());
 * ghosts->Update();          // by all processes together, when the data are new
 * compositor->RenderToImage(volume, camera, nullptr, 800, 600, picture);
 * @endcode
 *
 * The output has the blocks of the input, at the same indices, and one more level with blocks of
 * other processes. A block of another process is added if it is nearer to one of the own blocks
 * than four cells of the coarser of the two. If no coarser block lies behind it
 * (vtkNonOverlappingAMR), the distance is four of the coarsest cells that are near the own block.
 *
 * The cells of added blocks are hidden (vtkDataSetAttributes::HIDDENCELL), so that they are drawn
 * by their own process alone. The blocks are sent whole, with all arrays, which takes memory: this
 * filter is meant for blocks that are small compared with the data. A block that both processes
 * have is not sent. Blocks without arrays, which may stand for the blocks of other processes, are
 * left out.
 *
 * All processes must call Update() together, including those without blocks, which give no input or
 * an empty one: if the data of any process are new, all of them exchange blocks. (UpdatePiece() of
 * a piece other than the whole makes the filter run again, in some processes alone, when a mapper
 * requests the whole: do not call it.) A process whose input is of another kind reports an error,
 * and counts as one without blocks. With one process nothing is added.
 *
 * @sa vtkIsosurfaceRayTraceCompositor
 */

#ifndef vtkIsosurfaceGhostBlocks_h
#define vtkIsosurfaceGhostBlocks_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkIsosurfaceRayTracingCompat.h"         // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingParallelModule.h" // for export macro
#include "vtkSmartPointer.h"                       // for ivars

VTK_ABI_NAMESPACE_BEGIN

class vtkMultiProcessController;

class VTKISOSURFACERAYTRACINGPARALLEL_EXPORT vtkIsosurfaceGhostBlocks
  : public vtkDataObjectAlgorithm
{
public:
  static vtkIsosurfaceGhostBlocks* New();
  vtkTypeMacro(vtkIsosurfaceGhostBlocks, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/Get the controller of the processes. Default: null, which stands for the global controller,
   * or for a single process if there is no global controller.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  ///@{
  /**
   * Exchanges blocks if the data of any process are new. All processes must call it together.
   */
  using Superclass::Update;
  void Update() override;
  ///@}

  /**
   * Get the number of blocks of other processes in the output.
   */
  vtkGetMacro(NumberOfGhostBlocks, int);

protected:
  vtkIsosurfaceGhostBlocks();
  ~vtkIsosurfaceGhostBlocks() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkSmartPointer<vtkMultiProcessController> FindController() const;

  vtkIsosurfaceGhostBlocks(const vtkIsosurfaceGhostBlocks&) = delete;
  void operator=(const vtkIsosurfaceGhostBlocks&) = delete;

  vtkSmartPointer<vtkMultiProcessController> Controller;
  int NumberOfGhostBlocks = 0;
};

VTK_ABI_NAMESPACE_END

#endif
