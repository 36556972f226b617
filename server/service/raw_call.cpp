#include "service/raw_call.h"

namespace radiata::service {

void CancelHook::set(std::function<void()> function) {
    {
        std::lock_guard lock(mutex_);
        if (!cancelled_) {
            function_ = std::move(function);
            return;
        }
    }
    function();
}

void CancelHook::cancel() {
    std::function<void()> function;
    {
        std::lock_guard lock(mutex_);
        cancelled_ = true;
        function = std::move(function_);
    }
    if (function) function();
}

}  // namespace radiata::service
