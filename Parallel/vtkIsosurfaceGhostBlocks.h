// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceGhostBlocks
 * @brief   gives each process the AMR blocks of others that are next to its own
 *
 * A surface in AMR data goes on from block to block by the samples on both sides, and a block is
 * not drawn where another refines it. Blocks that are shared out over processes have neighbours in
 * other processes, of which VTK makes no ghosts: without them the pictures that
 * vtkIsosurfaceRayTraceCompositor composites have gaps and steps between the blocks of different
 * processes. With them, they are those of one process:
 *
 * @code
 * ghosts->SetInputData(amr); // in each process; of the global controller
 * mapper->SetInputConnection(ghosts->GetOutputPort());
 * ghosts->Update();          // by all processes together, when the data are new
 * compositor->RenderToImage(volume, camera, nullptr, 800, 600, picture);
 * @endcode
 *
 * The output has the blocks of the input, in their places, and another level with those of other
 * processes that come nearer to one of the own blocks than four cells of the coarser of the two;
 * those that no coarser block lies behind (vtkNonOverlappingAMR), than four of the coarsest cells
 * that are near the own block. Their cells are hidden (vtkDataSetAttributes::HIDDENCELL), so that
 * they are drawn by their own process alone. They are whole blocks, with all arrays, which takes
 * memory: it is for blocks that are small against the data. A block that both processes have is not
 * sent. Blocks without arrays, as which a process may have those of others, are left out.
 *
 * All processes must update the filter together, also those without blocks, whose input is empty.
 * (One whose input is of another kind reports an error, and counts as one without blocks.) With one
 * process nothing is added.
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
   * or for a single process where there is none.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
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
  vtkIsosurfaceGhostBlocks(const vtkIsosurfaceGhostBlocks&) = delete;
  void operator=(const vtkIsosurfaceGhostBlocks&) = delete;

  vtkSmartPointer<vtkMultiProcessController> Controller;
  int NumberOfGhostBlocks = 0;
};

VTK_ABI_NAMESPACE_END

#endif
