#include "render/frame/fiblet_peel.h"

#include "render/frame/fiblet_draw.h"

namespace radiata::render {

struct FibletPeel::Layer {
    Layer(PassRun& run, std::size_t index, bool alone, FibletPace& pace) : layer(run, index, alone, pace), drawing(layer) {}
    FibletRun layer;
    FibletDraw drawing;
};

FibletPeel::FibletPeel(PassRun& run, std::size_t layer, FibletPace& pace, bool alone, std::uint32_t slots, bool counted)
    : layer_(std::make_unique<Layer>(run, layer, alone, pace)), slots_(slots), counted_(counted) {
    layer_->drawing.raster().use.chain = slots;
    layer_->layer.prepare(run.target.frame().rays, run.list.camera.reference_mm);
    layer_->layer.own.preparePeels(run.device, run.pixels(), slots, counted);
}
FibletPeel::~FibletPeel() = default;
FibletPeel::FibletPeel(FibletPeel&&) noexcept = default;

void FibletPeel::find(std::uint32_t round) {
    FibletDraw& drawing = layer_->drawing;
    layer_->layer.run.checkCancelled();
    if (round % slots_ == 0) {
        FibletUse& use = drawing.raster().use;
        use.peeling = round > 0;
        use.counting = round == 0 && counted_;
        drawing.begin(false);
        drawing.drawWords();
        use.counting = false;
    }
    // No pixel takes more than one segment of a layer in a round.
    drawing.settleSheet(round % slots_);
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
