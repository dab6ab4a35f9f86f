//! A graphics processor: its buffers, programs and calls of them. It is independent of energies.

use std::time::{Duration, Instant};

use wgpu::util::DownloadBuffer;
use wgpu::{BindGroup, Buffer, BufferUsages, ComputePipeline, ErrorFilter, Limits, PollType};

use crate::Error;

/// An open device.
#[derive(Debug)]
pub struct Device {
    /// Name of the adapter.
    pub name: String,
    /// All that the adapter allows.
    pub limits: Limits,
    device: wgpu::Device,
    queue: wgpu::Queue,
}

impl Device {
    /// The fastest adapter, with its own limits.
    ///
    /// # Errors
    /// There is no adapter for Vulkan, or it cannot be opened.
    pub fn open() -> Result<Self, Error> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options)).map_err(|error| {
            let advice =
                "a driver is needed, or Mesa's for the processor: mesa-vulkan-drivers and libvulkan1 in Debian";
            format!("no adapter for Vulkan: {advice} ({error})")
        })?;
        let limits = adapter.limits();
        let descriptor = wgpu::DeviceDescriptor { required_limits: limits.clone(), ..Default::default() };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))?;
        Ok(Self { name: adapter.get_info().name, limits, device, queue })
    }

    /// Entry points of a text in WGSL, whose bindings are found in it, as programs.
    ///
    /// # Errors
    /// The text is not WGSL, or the driver does not compile it.
    pub fn programs(&self, text: &str, entries: &[&str]) -> Result<Vec<ComputePipeline>, Error> {
        let scope = self.device.push_error_scope(ErrorFilter::Validation);
        let source = wgpu::ShaderSource::Wgsl(text.into());
        let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
        let compile = |entry: &&str| {
            self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(*entry),
                layout: None,
                module: &module,
                entry_point: Some(*entry),
                compilation_options: Default::default(),
                cache: None,
            })
        };
        let programs = entries.iter().map(compile).collect();
        pollster::block_on(scope.pop()).map_or(Ok(programs), |error| Err(error.into()))
    }

    /// A buffer with these contents.
    #[must_use]
    pub fn filled<T: bytemuck::NoUninit>(&self, contents: &[T]) -> Buffer {
        let bytes = bytemuck::cast_slice(contents);
        let buffer = self.empty(bytes.len() as u64);
        self.queue.write_buffer(&buffer, 0, bytes);
        buffer
    }

    /// A buffer of zeros.
    #[must_use]
    pub fn empty(&self, bytes: u64) -> Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: bytes,
            usage: BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        })
    }

    /// Buffers in the order of the bindings of a program.
    #[must_use]
    pub fn bind(&self, program: &ComputePipeline, buffers: &[&Buffer]) -> BindGroup {
        let entries: Vec<_> = (0u32..)
            .zip(buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let layout = &program.get_bind_group_layout(0);
        self.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
    }

    /// Runs programs one after the other, each with its number of workgroups, and returns the time.
    ///
    /// # Errors
    /// The device is lost.
    pub fn run<'a>(
        &self,
        calls: impl IntoIterator<Item = (&'a ComputePipeline, &'a BindGroup, u32)>,
    ) -> Result<Duration, Error> {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        for (program, group, workgroups) in calls {
            pass.set_pipeline(program);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(workgroups, 1, 1);
        }
        drop(pass);
        let commands = encoder.finish();
        self.device.poll(PollType::wait_indefinitely())?;
        let start = Instant::now();
        self.queue.submit([commands]);
        self.device.poll(PollType::wait_indefinitely())?;
        Ok(start.elapsed())
    }

    /// The contents of a buffer.
    ///
    /// # Errors
    /// The device is lost, or has no memory.
    pub fn read<T: bytemuck::Pod>(&self, buffer: &Buffer) -> Result<Vec<T>, Error> {
        let (sender, receiver) = std::sync::mpsc::channel();
        DownloadBuffer::read_buffer(&self.device, &self.queue, &buffer.slice(..), move |result| {
            _ = sender.send(result);
        });
        self.device.poll(PollType::wait_indefinitely())?;
        Ok(bytemuck::pod_collect_to_vec(&receiver.recv()??))
    }
}
