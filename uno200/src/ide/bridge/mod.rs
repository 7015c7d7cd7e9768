//! The bridge: a WebSocket through which the page reaches ports of this computer and the folder of
//! its project, and nothing else. Who may use it `access` knows; what the bytes mean nobody does
//! here.

mod ports;
pub mod protocol;
mod way;

use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::sync::{Arc, Mutex, PoisonError};

use tungstenite::protocol::{Role, WebSocketConfig};
use tungstenite::{Message, WebSocket};

use super::access::Access;
use super::folder::{Folder, Listing, Written};
pub use ports::Ports;
use protocol::{Told, Wish};
use way::{Sink, Way};

/// Where it is on the server.
pub const PATH: &str = "/bridge";
/// No message is longer, unless it holds a file of a folder: then as long as the largest, with its
/// quotes and line ends escaped.
const MESSAGE_LEN_MAX: usize = 64 * 1024;
const FILE_MESSAGE_LEN_MAX: usize = 10_000_000;

/// What pages reach through it.
#[derive(Debug)]
pub struct Reach {
    /// The ports.
    pub ports: Arc<Ports>,
    /// The folder of the project, if one was given.
    pub folder: Option<Folder>,
}

/// Serves a page at the other end of a connection until that ends.
pub fn serve(stream: TcpStream, access: &Access, reach: &Reach) -> io::Result<()> {
    // Of a page that sleeps nothing may come for hours.
    stream.set_read_timeout(None)?;
    stream.set_nodelay(true)?;
    let end = Arc::new(Mutex::new(stream.try_clone()?));
    let both = Both { reader: stream, writer: Arc::clone(&end) };
    let config = WebSocketConfig::default()
        .max_message_size(Some(MESSAGE_LEN_MAX))
        .max_frame_size(Some(MESSAGE_LEN_MAX));
    let mut page = Page {
        socket: WebSocket::from_raw_socket(both, Role::Server, Some(config)),
        sink: sink(end),
        reach,
        way: None,
    };
    // However it ends, the port is closed.
    if page.welcome(access).is_ok() {
        let len = reach.folder.as_ref().map_or(MESSAGE_LEN_MAX, |_| FILE_MESSAGE_LEN_MAX);
        page.socket.set_config(|config| {
            config.max_message_size = Some(len);
            config.max_frame_size = Some(len);
        });
        while page.go_on().is_ok() {}
    }
    Ok(())
}

/// A page at the other end.
struct Page<'a> {
    socket: WebSocket<Both>,
    sink: Sink,
    reach: &'a Reach,
    way: Option<Way>,
}

impl Page<'_> {
    /// The first message says who it is.
    fn welcome(&mut self, access: &Access) -> tungstenite::Result<()> {
        let wish = match self.socket.read()? {
            Message::Text(text) => serde_json::from_str(&text).ok(),
            _ => None,
        };
        let session = match &wish {
            Some(Wish::Hello { token: Some(token), .. }) => access.exchange(token),
            Some(Wish::Hello { session: Some(session), .. }) => access.come_back(session),
            _ => Err("the first message is hello, with token or session"),
        };
        match session {
            Ok(session) => self.tell(&Told::Welcome {
                session: session.to_owned(),
                folder: self.reach.folder.is_some(),
            }),
            Err(message) => {
                self.tell(&Told::Refused { message: message.to_owned() })?;
                self.socket.close(None)?;
                // The other end answers that it closes, too.
                while self.socket.read().is_ok() {}
                Err(tungstenite::Error::ConnectionClosed)
            }
        }
    }

    /// Takes the next message.
    fn go_on(&mut self) -> tungstenite::Result<()> {
        match self.socket.read()? {
            Message::Text(text) => {
                let told = match serde_json::from_str(&text) {
                    Ok(wish) => self.fulfil(wish),
                    Err(error) => Err(format!("no message of the bridge: {error}")),
                };
                self.tell(&told.unwrap_or_else(|message| Told::Refused { message }))
            }
            Message::Binary(bytes) => {
                let sent = self.way.as_mut().map_or(Ok(()), |way| way.send(&bytes));
                match sent {
                    Ok(()) => Ok(()),
                    Err(message) => {
                        self.way = None;
                        self.tell(&Told::Lost { message })
                    }
                }
            }
            _ => Ok(()),
        }
    }

    fn fulfil(&mut self, wish: Wish) -> Result<Told, String> {
        match wish {
            Wish::Hello { .. } => Err("that was said already".to_owned()),
            Wish::Ports => Ok(Told::Ports { ports: self.reach.ports.all() }),
            Wish::Open { name, baud, parity } => {
                self.way = None;
                let taken = self.reach.ports.take(&name)?;
                let sink = Arc::clone(&self.sink);
                let way = Way::open(taken, baud, parity.into(), sink);
                self.way = Some(way.map_err(|error| error.to_string())?);
                Ok(Told::Done)
            }
            Wish::Lines { on } => match &mut self.way {
                Some(way) => way.lines(on).map(|()| Told::Done).map_err(|error| error.to_string()),
                None => Err("no port is open".to_owned()),
            },
            Wish::Close => {
                self.way = None;
                Ok(Told::Done)
            }
            Wish::Folder => {
                let folder = self.folder()?;
                let Listing { files, left_out } = folder.listing()?;
                Ok(Told::Folder { id: folder.id(), name: folder.name(), files, left_out })
            }
            Wish::Read { file } => {
                let (text, version) = self.folder()?.read(&file)?;
                Ok(Told::File { text, version })
            }
            Wish::Save { file, text, base } => {
                self.folder()?.save(&file, &text, base.as_deref()).map(written)
            }
            Wish::Remove { file, base } => self.folder()?.remove(&file, &base).map(written),
        }
    }

    fn folder(&self) -> Result<&Folder, String> {
        let folder = self.reach.folder.as_ref();
        folder.ok_or_else(|| "no folder was given: `uno200 ide FOLDER`".to_owned())
    }

    fn tell(&mut self, told: &Told) -> tungstenite::Result<()> {
        self.socket.send(text(told))
    }
}

fn written(written: Written) -> Told {
    match written {
        Written::Done { version, note } => Told::Saved { version, note },
        Written::Changed(version) => Told::Changed { version },
    }
}

fn text(told: &Told) -> Message {
    Message::text(serde_json::to_string(told).unwrap_or_default())
}

/// Sends what comes from a port straight to the page. Frames to a page depend on none before them.
fn sink(end: Arc<Mutex<TcpStream>>) -> Sink {
    let socket = Mutex::new(WebSocket::from_raw_socket(Writer(end), Role::Server, None));
    Arc::new(move |news| {
        let message = match news {
            Ok(bytes) => Message::binary(bytes.to_vec()),
            Err(message) => text(&Told::Lost { message }),
        };
        // A page that has gone away is seen by who reads from it.
        let _ = socket.lock().unwrap_or_else(PoisonError::into_inner).send(message);
    })
}

/// A connection that others write to as well: a frame is written whole, or others wait.
struct Both {
    reader: TcpStream,
    writer: Arc<Mutex<TcpStream>>,
}

/// The way out alone.
struct Writer(Arc<Mutex<TcpStream>>);

fn write_whole(end: &Mutex<TcpStream>, bytes: &[u8]) -> io::Result<usize> {
    end.lock().unwrap_or_else(PoisonError::into_inner).write_all(bytes)?;
    Ok(bytes.len())
}

impl Read for Both {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.reader.read(bytes)
    }
}

impl Write for Both {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        write_whole(&self.writer, bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Read for Writer {
    fn read(&mut self, _bytes: &mut [u8]) -> io::Result<usize> {
        Err(io::ErrorKind::Unsupported.into())
    }
}

impl Write for Writer {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        write_whole(&self.0, bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
