//! The studio as a browser meets it: over HTTP and WebSockets.
