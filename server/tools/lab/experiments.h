// One function per experiment; experiments.cpp names them.
#pragma once

#include "tools/lab/experiment.h"

namespace radiata::lab {

Report glyphFrame(gpu::Device& device, const Options& options);
Report marchVersusPolynomial(gpu::Device& device, const Options& options);
Report petersFig4(gpu::Device& device, const Options& options);
Report petersFig5(gpu::Device& device, const Options& options);
Report glyphPareto(gpu::Device& device, const Options& options);
Report petersBounds(gpu::Device& device, const Options& options);
Report petersFig1(gpu::Device& device, const Options& options);
Report petersFig3(gpu::Device& device, const Options& options);
Report petersFig6(gpu::Device& device, const Options& options);
Report petersTable1(gpu::Device& device, const Options& options);
Report petersFig7(gpu::Device& device, const Options& options);
Report hlawitschkaTable1(gpu::Device& device, const Options& options);
Report hlawitschkaTable2(gpu::Device& device, const Options& options);
Report hlawitschkaFig1(gpu::Device& device, const Options& options);
Report hlawitschkaFig2(gpu::Device& device, const Options& options);
Report hlawitschkaFig5(gpu::Device& device, const Options& options);
Report isosurfaceHits(gpu::Device& device, const Options& options);
Report wymanFig5(gpu::Device& device, const Options& options);
Report wymanFig6(gpu::Device& device, const Options& options);
Report wymanFig7(gpu::Device& device, const Options& options);
Report wymanFig9(gpu::Device& device, const Options& options);
Report wymanFig12(gpu::Device& device, const Options& options);
Report wymanTable2(gpu::Device& device, const Options& options);
Report wymanTable1(gpu::Device& device, const Options& options);
Report wymanFig4(gpu::Device& device, const Options& options);
Report wymanFig10(gpu::Device& device, const Options& options);
Report wymanFig11(gpu::Device& device, const Options& options);
Report illuminationSampling(gpu::Device& device, const Options& options);
Report illuminationFirst(gpu::Device& device, const Options& options);
Report illuminationMemory(gpu::Device& device, const Options& options);
Report illuminationPareto(gpu::Device& device, const Options& options);
Report fibletCodec(gpu::Device& device, const Options& options);
Report schertzerTable1(gpu::Device& device, const Options& options);
Report schertzerFig9(gpu::Device& device, const Options& options);
Report fibletPipelines(gpu::Device& device, const Options& options);
Report schertzerTable2(gpu::Device& device, const Options& options);
Report schertzerTable3(gpu::Device& device, const Options& options);
Report schertzerFig8(gpu::Device& device, const Options& options);
Report fibletScaling(gpu::Device& device, const Options& options);
Report fibletStreaming(gpu::Device& device, const Options& options);

}  // namespace radiata::lab
