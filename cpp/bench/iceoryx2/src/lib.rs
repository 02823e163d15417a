//! iceoryx2 as a mechanism of `hand_over`: one publisher, one subscriber, the latest datum alone, shared in place.
//!
//! Its own C++ interface is built from a checkout of its repository; this is the same crate through functions of C. Each
//! side has a node of its own and is used by one thread.

use core::ffi::c_void;
use core::mem::MaybeUninit;

use iceoryx2::port::publisher::Publisher;
use iceoryx2::port::subscriber::Subscriber;
use iceoryx2::prelude::*;
use iceoryx2::sample::Sample;
use iceoryx2::sample_mut_uninit::SampleMutUninit;

type Service = ipc::Service;

/// A datum on its way.
type Loan = SampleMutUninit<Service, [MaybeUninit<u64>], ()>;

pub struct Channel {
    publisher: Publisher<Service, [u64], ()>,
    subscriber: Subscriber<Service, [u64], ()>,
    loan: Option<Loan>,
    taken: Option<Sample<Service, [u64], ()>>,
    words: usize,
}

fn open(name: &str, words: usize) -> Result<Channel, Box<dyn core::error::Error>> {
    set_log_level(LogLevel::Error);
    let name = ServiceName::new(name)?;
    let service = || -> Result<_, Box<dyn core::error::Error>> {
        let node = NodeBuilder::new().create::<Service>()?;
        let builder = node.service_builder(&name).publish_subscribe::<[u64]>();
        Ok(builder.subscriber_max_buffer_size(1).history_size(0).enable_safe_overflow(true).open_or_create()?)
    };
    let publisher = service()?.publisher_builder().initial_max_slice_len(words).create()?;
    let subscriber = service()?.subscriber_builder().create()?;
    Ok(Channel { publisher, subscriber, loan: None, taken: None, words })
}

/// A channel of data of so many words, or null. Lives until the program ends.
#[unsafe(no_mangle)]
pub extern "C" fn bench_iceoryx2_open(number: u32, words: usize) -> *mut c_void {
    let name = format!("groundstate/bench/{}/{number}", std::process::id());
    match open(&name, words) {
        Ok(channel) => Box::into_raw(Box::new(channel)).cast(),
        Err(error) => {
            eprintln!("iceoryx2: {error}");
            core::ptr::null_mut()
        }
    }
}

/// Where to write the next datum, or null.
///
/// # Safety
/// `channel` is one that was opened; one thread writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bench_iceoryx2_loan(channel: *mut c_void) -> *mut u64 {
    let words = unsafe { (*channel.cast::<Channel>()).words };
    let (publisher, loan) = unsafe {
        let channel = channel.cast::<Channel>();
        (&(*channel).publisher, &mut (*channel).loan)
    };
    match publisher.loan_slice_uninit(words) {
        Ok(sample) => loan.insert(sample).payload_mut().as_mut_ptr().cast(),
        Err(_) => core::ptr::null_mut(),
    }
}

/// Sends what was written where `loan` said.
///
/// # Safety
/// As of `loan`; the datum was written whole.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bench_iceoryx2_send(channel: *mut c_void) {
    let loan = unsafe { &mut (*channel.cast::<Channel>()).loan };
    if let Some(sample) = loan.take() {
        let _ = unsafe { sample.assume_init() }.send();
    }
}

/// The latest datum, new or not; null if there was none. It stays until the next call.
///
/// # Safety
/// `channel` is one that was opened; one thread reads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bench_iceoryx2_take(channel: *mut c_void) -> *const u64 {
    let (subscriber, taken) = unsafe {
        let channel = channel.cast::<Channel>();
        (&(*channel).subscriber, &mut (*channel).taken)
    };
    if let Ok(Some(sample)) = subscriber.receive() {
        *taken = Some(sample);
    }
    taken.as_ref().map_or(core::ptr::null(), |sample| sample.payload().as_ptr())
}
