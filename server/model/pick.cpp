#include "model/pick.h"

#include "base/error.h"
#include "model/frame.h"

namespace radiata::model {

void checkAllHits(const FrameRequest& request) {
    if (findsAllHits(request.quality.intersection)) return;
    std::string able;
    for (const MethodName& row : kMethodNames) {
        if (findsAllHits(row.method)) able += (able.empty() ? "" : ", ") + std::string(row.name);
    }
    throw Error(Code::kInvalidArgument, "quality.intersection is " + std::string(methodName(request.quality.intersection)) +
                                            ", which stops at a ray's first hit; all hits are found by " + able);
}

}  // namespace radiata::model
