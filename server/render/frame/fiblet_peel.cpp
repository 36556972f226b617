#include "render/frame/fiblet_peel.h"

#include "render/frame/fiblet_draw.h"

namespace radiata::render {

struct FibletPeel::Layer {
    Layer(PassRun& run, std::size_t index, bool alone, FibletPace& pace) : layer(run, index, alone, pace), drawing(layer) {}
    FibletRun layer;
    FibletDraw drawing;
};

FibletPeel::FibletPeel(PassRun& run, std::size_t layer, FibletPace& pace, bool alone, bool counted)
    : layer_(std::make_unique<Layer>(run, layer, alone, pace)), counted_(counted) {
    layer_->drawing.raster().use.peels = true;
    layer_->layer.prepare(run.target.frame().rays, run.list.camera.reference_mm);
    layer_->layer.own.preparePeels(run.device, run.pixels(), counted);
}
FibletPeel::~FibletPeel() = default;
FibletPeel::FibletPeel(FibletPeel&&) noexcept = default;

void FibletPeel::find(bool first) {
    FibletDraw& drawing = layer_->drawing;
    layer_->layer.run.checkCancelled();
    FibletUse& use = drawing.raster().use;
    use.peeling = !first;
    use.counting = first && counted_;
    drawing.begin(false);
    drawing.drawWords();
    use.counting = false;
    drawing.settle({});
}

std::uint64_t FibletPeel::address() const { return layer_->layer.own.layerAddress(); }

void runFibletsThrough(PassRun& run, const plan::PassPlan& pass, std::uint64_t inside, std::uint64_t found) {
    FibletPace pace;
    FibletRun layer(run, static_cast<std::size_t>(pass.layer), pass.first, pace);
    FibletDraw drawing(layer);
    drawing.raster().use.finding = true;
    layer.prepare(run.target.frame().rays, run.list.camera.reference_mm);
    layer.own.layer().inside = inside;
    layer.own.layer().found = found;
    drawing.drawWords();
    layer.own.knows_visible = false;
}

}  // namespace radiata::render
