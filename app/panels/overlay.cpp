#include "app/panels/overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <cmath>

#include "base/error.h"

namespace lw {
namespace {

/// Sets dark colours, opaque enough to be read over a bright room, and sizes for this scale.
void set_look(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = style.FrameRounding = style.GrabRounding = 3;
    style.WindowBorderSize = 0;
    style.Colors[ImGuiCol_WindowBg] = ImVec4(0.07f, 0.075f, 0.085f, 0.93f);
    style.Colors[ImGuiCol_PopupBg] = ImVec4(0.09f, 0.095f, 0.105f, 0.98f);
    style.Colors[ImGuiCol_TitleBgActive] = ImVec4(0.16f, 0.20f, 0.26f, 1);
    style.Colors[ImGuiCol_FrameBg] = ImVec4(0.20f, 0.22f, 0.25f, 0.9f);
    style.Colors[ImGuiCol_SliderGrab] = ImVec4(0.95f, 0.75f, 0.35f, 1);
    style.Colors[ImGuiCol_SliderGrabActive] = ImVec4(1.0f, 0.85f, 0.5f, 1);
    style.Colors[ImGuiCol_CheckMark] = ImVec4(0.95f, 0.75f, 0.35f, 1);
    style.ScaleAllSizes(scale);
    ImFontConfig font;
    font.SizePixels = std::floor(13 * scale);
    ImGui::GetIO().Fonts->AddFontDefault(&font);
}

void check(VkResult result) {
    if (result == VK_ERROR_DEVICE_LOST) throw vk::DeviceLostError("panels");
    if (result < 0) throw Error("panels: Vulkan refuses: " + vk::to_string(vk::Result(result)));
}

void upload_fonts(const Device& device) {
#if IMGUI_VERSION_NUM >= 19000
    ImGui_ImplVulkan_CreateFontsTexture();
#else
    submit_and_wait(device, [](vk::CommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
#endif
}

}  // namespace

Overlay::Overlay(const Window& window, const Device& device, const Swapchain& swapchain) : device_(&device) {
    const vk::DescriptorPoolSize images(vk::DescriptorType::eCombinedImageSampler, 8);
    pool_ =
        device.handle().createDescriptorPoolUnique({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 8, images});
    make_render_pass(swapchain.format());
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // ImGui writes no file of its own
    set_look(window.scale());
    ImGui_ImplGlfw_InitForVulkan(window.handle(), true);
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = device.instance();
    info.PhysicalDevice = device.physical();
    info.Device = device.handle();
    info.QueueFamily = device.queue_family();
    info.Queue = device.queue();
    info.DescriptorPool = *pool_;
    info.MinImageCount = 2;
    info.ImageCount = std::max(2u, swapchain.count());
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = check;
    ImGui_ImplVulkan_Init(&info, *render_pass_);
    upload_fonts(device);
    attach(swapchain);
}

Overlay::~Overlay() {
    try {
        device_->handle().waitIdle();
    } catch (const vk::SystemError&) {  // the device is lost: there is nothing to wait for
    }
    ImGui_ImplVulkan_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Overlay::make_render_pass(vk::Format format) {
    const auto layout = vk::ImageLayout::eColorAttachmentOptimal;
    const vk::AttachmentDescription target({}, format, vk::SampleCountFlagBits::e1, vk::AttachmentLoadOp::eLoad,
                                           vk::AttachmentStoreOp::eStore, vk::AttachmentLoadOp::eDontCare,
                                           vk::AttachmentStoreOp::eDontCare, layout, layout);
    const vk::AttachmentReference reference(0, layout);
    const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, reference);
    const auto stage = vk::PipelineStageFlagBits::eColorAttachmentOutput;
    const auto access = vk::AccessFlagBits::eColorAttachmentRead | vk::AccessFlagBits::eColorAttachmentWrite;
    const std::array dependencies{vk::SubpassDependency(VK_SUBPASS_EXTERNAL, 0, stage, stage, access, access),
                                  vk::SubpassDependency(0, VK_SUBPASS_EXTERNAL, stage, stage, access, access)};
    render_pass_ = device_->handle().createRenderPassUnique({{}, target, subpass, dependencies});
}

void Overlay::attach(const Swapchain& swapchain) {
    size_ = swapchain.size();
    framebuffers_.clear();
    for (uint32_t i = 0; i < swapchain.count(); ++i) {
        const vk::ImageView view = swapchain.view(i);
        framebuffers_.push_back(
            device_->handle().createFramebufferUnique({{}, *render_pass_, view, size_.width, size_.height, 1}));
    }
}

void Overlay::begin(bool mouse) const {
    ImGuiIO& io = ImGui::GetIO();
    if (mouse)
        io.ConfigFlags &= ~ImGuiConfigFlags_NoMouse;
    else
        io.ConfigFlags |= ImGuiConfigFlags_NoMouse;
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Overlay::record(vk::CommandBuffer commands, uint32_t image) const {
    ImGui::Render();
    commands.beginRenderPass(vk::RenderPassBeginInfo(*render_pass_, *framebuffers_[image], {{0, 0}, size_}),
                             vk::SubpassContents::eInline);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
    commands.endRenderPass();
}

bool Overlay::wants_mouse() const { return ImGui::GetIO().WantCaptureMouse; }

bool Overlay::wants_keyboard() const { return ImGui::GetIO().WantTextInput; }

}  // namespace lw
